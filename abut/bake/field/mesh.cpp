#include <abut/bake/field.hpp>
#include <abut/bake/field/fill.hpp>
#include <abut/bake/field/grid.hpp>
#include <abut/bake/field/nearest_primitive.hpp>
#include <abut/bake/field/primitive_bvh.hpp>
#include <abut/bake/field/reused_samples.hpp>
#include <abut/bake/field/scanlines.hpp>
#include <abut/bake/field/surface.hpp>
#include <abut/bake/field/winding_number.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace abut {

using namespace detail;

namespace {

std::vector<PrimitiveCorners<3>> primitives_of(const FieldSurface& surface) {
    std::vector<PrimitiveCorners<3>> result;
    result.reserve(surface.nondegenerate.size());
    const std::vector<Vec3>& points = surface.mesh.points;
    for (const std::uint32_t i : surface.nondegenerate) {
        const glm::uvec3& t = surface.mesh.triangles[i];
        result.push_back({points[t.x], points[t.y], points[t.z]});
    }
    return result;
}

ScanlineWindings scanline_windings_of(const FieldSurface& surface, const FieldData<3>& grid) {
    const std::array<std::span<const glm::uvec3>, 2> closed{surface.mesh.triangles, surface.cap};
    return {Scanlines(surface.mesh.points, lattice_of(grid), samples_along(grid)), closed};
}

/// The offset from the origin to the closest point of a triangle, by its Voronoi regions.
DVec<3> closest_offset(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
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
        : primitives_(primitives_of(surface)),
          tree_(build_primitive_bvh<3>(primitives_)),
          closed_windings_(scanline_windings_of(surface, grid)),
          cap_(surface.mesh.points, surface.cap),
          surface_(surface.mesh.points, surface.cap.empty() ? std::span<const glm::uvec3>() : surface.mesh.triangles),
          lattice_(lattice_of(grid)) {
        double volume = 0;
        const DVec<3> from(primitives_.front()[0]);
        for (const PrimitiveCorners<3>& primitive : primitives_)
            volume +=
                dot(DVec<3>(primitive[0]) - from, cross(DVec<3>(primitive[1]) - from, DVec<3>(primitive[2]) - from));
        orientation_ = volume < 0 ? -1 : 1;
    }

    void evaluate(const SampleBlock<3>& block, const SampleValues<3>& values) const override {
        std::array<NearestPrimitive, max_block_samples<3>> nearest;
        std::array<std::int32_t, max_block_samples<3>> windings;
        nearest_primitives(tree_, lattice_, block, nearest.data());
        for (std::uint32_t i = 0; i < block.samples(); i += block.count.x)
            closed_windings_.evaluate(block.sample(i), block.count.x, block.stride, &windings[i]);
        for (std::uint32_t i = 0; i < block.samples(); ++i) {
            const double distance = square_root(nearest[i].squared);
            const double winding = winding_number(lattice_.at(block.sample(i)), windings[i]);
            const bool inside = winding >= 0.5;
            values.distance[i] = static_cast<float>(inside ? -distance : distance);
            if (values.uncertain != nullptr) values.uncertain[i] = std::abs(winding - 0.5) <= 0.25;
            if (values.gradient == nullptr && values.closest == nullptr) continue;
            const DVec<3> point = lattice_.at(block.sample(i)),
                          offset = offset_to_primitive(point, nearest[i].primitive);
            if (values.closest != nullptr) values.closest[i] = to_float(point + offset);
            if (values.gradient != nullptr)
                values.gradient[i] =
                    to_float(distance > 0x1p-40 * tree_.diameter_bound ? normalized(inside ? offset : -offset)
                                                                       : normal_of(nearest[i].primitive));
        }
    }
    double distance(const DVec<3>& point) const override {
        return square_root(nearest_primitive(tree_, point).squared);
    }

private:
    /// The absolute winding number of the open surface. `closed_winding` is that of the surface and its cap together.
    double winding_number(const DVec<3>& point, std::int32_t closed_winding) const {
        if (cap_.empty()) return std::abs(closed_winding);
        // The winding number of the cap is discontinuous on the cap: on it the surface is evaluated instead. On the
        // surface no winding number is defined.
        if (const std::optional<double> found = open_winding(cap_, point, closed_winding)) return *found;
        return open_winding(surface_, point, 0).value_or(0);
    }
    /// The exact evaluation is used only near 0.5, the threshold between inside and outside.
    static std::optional<double> open_winding(const GeneralizedWindingNumber& angles, const DVec<3>& point,
                                              std::int32_t closed_winding) {
        constexpr double near_half = 0.3;
        std::optional<double> found = angles.approximate(point);
        if (found && std::abs(std::abs(closed_winding - *found) - 0.5) <= near_half) found = angles.exact(point);
        if (found) found = std::abs(closed_winding - *found);
        return found;
    }

    DVec<3> offset_to_primitive(const DVec<3>& point, std::uint32_t primitive) const {
        const PrimitiveCorners<3>& p = primitives_[primitive];
        return closest_offset(DVec<3>(p[0]) - point, DVec<3>(p[1]) - point, DVec<3>(p[2]) - point);
    }
    /// The outward normal, for a sample on the surface.
    DVec<3> normal_of(std::uint32_t primitive) const {
        const DVec<3> a(primitives_[primitive][0]), b(primitives_[primitive][1]), c(primitives_[primitive][2]);
        return normalized(cross(b - a, c - a)) * orientation_;
    }

    std::vector<PrimitiveCorners<3>> primitives_;
    PrimitiveBvh<3> tree_;
    ScanlineWindings closed_windings_;
    GeneralizedWindingNumber cap_;
    GeneralizedWindingNumber surface_;  ///< empty if there is no cap
    SampleLattice<3> lattice_;
    double orientation_;
};

FieldReport report_of(const FieldSurface& surface) {
    FieldReport result;
    result.closed = surface.gaps == 0;
    result.gaps = surface.gaps;
    result.rewound = surface.rewound;
    return result;
}

Result<Field<3>> filled(FieldData<3> grid, const SampleSource<3>& source, const FieldOptions<3>& options, BakeJob& job,
                        FieldReport report) {
    Result<Field<3>> field = fill_field(std::move(grid), source, options, job, report);
    if (field && options.report != nullptr) *options.report = report;
    return field;
}

}  // namespace

Result<Field<3>> bake_field(const PointSpan<3>& points, std::span<const glm::uvec3> triangles,
                            const FieldOptions<3>& options) {
    BakeJob job(options);
    if (!job.begin(0.1)) return BakeJob::cancelled();
    const Result<FieldSurface> surface = field_surface(PackedPoints<3>(points).points(), triangles);
    if (!surface) return surface.problem();
    Result<FieldData<3>> grid = field_grid(surface->box, options);
    if (!grid) return grid.problem();
    const MeshSource source(*surface, *grid);
    return filled(*std::move(grid), source, options, job, report_of(*surface));
}

Result<Field<3>> bake_field(const Mesh& mesh, const FieldOptions<3>& options) {
    return bake_field(mesh.points(), mesh.triangles(), options);
}

Result<Field<3>> rebake_field(const Field<3>& field, const Aabb3& changed, const PointSpan<3>& points,
                              std::span<const glm::uvec3> triangles, const FieldOptions<3>& options) {
    const FieldData<3>& before = field.data();
    if (options.store != before.store || options.lookup != before.lookup ||
        options.closest_points == before.closest.empty() || options.quantised == before.steps.empty() ||
        (options.cell != 0 && options.cell != before.cell) || !(options.band >= 1))
        return Problem{ProblemCode::bad_argument, "the field wasn't baked with these options", 0};
    BakeJob job(options);
    if (!job.begin(0.1)) return BakeJob::cancelled();
    const Result<FieldSurface> surface = field_surface(PackedPoints<3>(points).points(), triangles);
    if (!surface) return surface.problem();
    FieldData<3> grid;
    grid.origin = before.origin;
    grid.cell = before.cell;
    grid.cells = before.cells;
    grid.store = before.store;
    grid.lookup = before.lookup;
    grid.surface = surface->box;
    const MeshSource source(*surface, grid);
    // The sign of an open surface depends on all triangles, and quantised samples are not the evaluated ones.
    if (surface->gaps > 0 || !before.steps.empty())
        return filled(std::move(grid), source, options, job, report_of(*surface));
    const ReusedSource<3> reused(source, before, changed);
    return filled(std::move(grid), reused, options, job, report_of(*surface));
}

Result<Field<3>> rebake_field(const Field<3>& field, const Aabb3& changed, const Mesh& mesh,
                              const FieldOptions<3>& options) {
    return rebake_field(field, changed, mesh.points(), mesh.triangles(), options);
}

}  // namespace abut
