#include <abut/bake/field_grid.hpp>
#include <abut/bake/field_lines.hpp>
#include <abut/bake/field_mesh_source.hpp>
#include <abut/bake/field_nearest.hpp>
#include <abut/bake/field_pieces.hpp>
#include <abut/bake/solid_angles.hpp>
#include <abut/math/dvec.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace abut {
namespace {

std::vector<PieceCorners<3>> pieces_of(const FieldSurface& surface) {
    std::vector<PieceCorners<3>> result;
    result.reserve(surface.solid.size());
    const std::vector<Vec3>& points = surface.mesh.points;
    for (const std::uint32_t i : surface.solid) {
        const glm::uvec3& t = surface.mesh.triangles[i];
        result.push_back({points[t.x], points[t.y], points[t.z]});
    }
    return result;
}

LineCounts counts_of(const FieldSurface& surface, const FieldData<3>& grid) {
    const std::array<std::span<const glm::uvec3>, 2> closed{surface.mesh.triangles, surface.cap};
    return {SampleLines(surface.mesh.points, lattice_of(grid), samples_along(grid)), closed};
}

/// The way from p, the origin, to the closest point of a triangle.
DVec<3> way_to(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    const auto to_segment = [](const DVec<3>& from, const DVec<3>& to) {
        const DVec<3> along = to - from;
        const double t = std::clamp(-dot(from, along) / dot(along, along), 0.0, 1.0);
        return from + along * t;
    };
    const DVec<3> normal = cross(b - a, c - a);
    if (dot(cross(normal, b - a), a) <= 0 && dot(cross(normal, c - b), b) <= 0 && dot(cross(normal, a - c), c) <= 0)
        return normal * (dot(normal, a) / dot(normal, normal));
    const DVec<3> ab = to_segment(a, b), bc = to_segment(b, c), ca = to_segment(c, a);
    const DVec<3>& first = dot(ab, ab) <= dot(bc, bc) ? ab : bc;
    return dot(first, first) <= dot(ca, ca) ? first : ca;
}

class MeshSource final : public SampleSource<3> {
public:
    MeshSource(const FieldSurface& surface, const FieldData<3>& grid)
        : pieces_(pieces_of(surface)),
          tree_(build_piece_tree<3>(pieces_)),
          counts_(counts_of(surface, grid)),
          cap_(surface.mesh.points, surface.cap),
          surface_(surface.mesh.points, surface.cap.empty() ? std::span<const glm::uvec3>() : surface.mesh.triangles),
          lattice_(lattice_of(grid)) {
        double volume = 0;
        const DVec<3> from(pieces_.front()[0]);
        for (const PieceCorners<3>& piece : pieces_)
            volume += dot(DVec<3>(piece[0]) - from, cross(DVec<3>(piece[1]) - from, DVec<3>(piece[2]) - from));
        outwards_ = volume < 0 ? -1 : 1;
    }

    void tell(const SampleBlock<3>& block, const SampleValues<3>& values) const override {
        std::array<NearestPiece, most_block_samples<3>> nearest;
        std::array<std::int32_t, most_block_samples<3>> turns;
        nearest_pieces(tree_, lattice_, block, nearest.data());
        for (std::uint32_t i = 0; i < block.samples(); i += block.count.x)
            counts_.tell(block.sample(i), block.count.x, block.stride, &turns[i]);
        for (std::uint32_t i = 0; i < block.samples(); ++i) {
            const double distance = std::sqrt(nearest[i].squared);
            const double winding = winding_number(lattice_.at(block.sample(i)), turns[i]);
            const bool inside = winding >= 0.5;
            values.distance[i] = static_cast<float>(inside ? -distance : distance);
            if (values.doubtful != nullptr) values.doubtful[i] = std::abs(winding - 0.5) <= 0.25;
            if (values.gradient == nullptr && values.closest == nullptr) continue;
            const DVec<3> point = lattice_.at(block.sample(i)), way = way_to_piece(point, nearest[i].piece);
            if (values.closest != nullptr) values.closest[i] = to_float(point + way);
            if (values.gradient != nullptr)
                values.gradient[i] = to_float(distance > 0x1p-40 * tree_.spread ? normalized(inside ? way : -way)
                                                                                : normal_of(nearest[i].piece));
        }
    }
    double distance(const DVec<3>& point) const override { return std::sqrt(nearest_piece(tree_, point).squared); }

private:
    /// Without its sign, where the surface and its cap together go round the point so often.
    double winding_number(const DVec<3>& point, std::int32_t together) const {
        if (cap_.empty()) return std::abs(together);
        // In a triangle of the cap it jumps: there the surface is asked itself. In one of that there is no telling.
        if (const std::optional<double> found = less(cap_, point, together)) return *found;
        return less(surface_, point, 0).value_or(0);
    }
    /// Exact near 0.5, which parts in from out.
    static std::optional<double> less(const SolidAngles& angles, const DVec<3>& point, std::int32_t together) {
        constexpr double near_half = 0.3;
        std::optional<double> found = angles.nearly(point);
        if (found && std::abs(std::abs(together - *found) - 0.5) <= near_half) found = angles.exactly(point);
        if (found) found = std::abs(together - *found);
        return found;
    }

    DVec<3> way_to_piece(const DVec<3>& point, std::uint32_t piece) const {
        const PieceCorners<3>& p = pieces_[piece];
        return way_to(DVec<3>(p[0]) - point, DVec<3>(p[1]) - point, DVec<3>(p[2]) - point);
    }
    /// Out of the surface, where a sample lies on it.
    DVec<3> normal_of(std::uint32_t piece) const {
        const DVec<3> a(pieces_[piece][0]), b(pieces_[piece][1]), c(pieces_[piece][2]);
        return normalized(cross(b - a, c - a)) * outwards_;
    }

    std::vector<PieceCorners<3>> pieces_;
    PieceTree<3> tree_;
    LineCounts counts_;
    SolidAngles cap_;
    SolidAngles surface_;  ///< where there is a cap
    SampleLattice<3> lattice_;
    double outwards_;
};

}  // namespace

std::unique_ptr<const SampleSource<3>> mesh_source(const FieldSurface& surface, const FieldData<3>& grid) {
    return std::make_unique<const MeshSource>(surface, grid);
}

}  // namespace abut
