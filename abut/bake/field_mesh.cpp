#include <abut/bake/field.hpp>
#include <abut/bake/field_fill.hpp>
#include <abut/bake/field_grid.hpp>
#include <abut/bake/field_surface.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/sin_cos.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace abut {
namespace {

/// The point of a triangle closest to p, seen from p.
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

double solid_angle(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    const double la = length(a), lb = length(b), lc = length(c), volume = dot(a, cross(b, c));
    const double rest = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return volume == 0 && rest == 0 ? 0 : 2 * angle_of(rest, volume);
}

class MeshSource final : public SampleSource<3> {
public:
    MeshSource(const FieldSurface& surface, Mesh mesh, const SampleLattice<3>& lattice)
        : surface_(surface), mesh_(std::move(mesh)), lattice_(lattice) {}

    void tell(const SampleBlock<3>& block, const SampleValues<3>& values) const override {
        for (std::uint32_t i = 0; i < block.samples(); ++i) {
            const DVec<3> point = lattice_.at(block.sample(i));
            const DVec<3> way = nearest(point);
            const double distance = length(way), winding = winding_of(point);
            const bool inside = winding >= 0.5;
            values.distance[i] = static_cast<float>(inside ? -distance : distance);
            if (values.gradient != nullptr) values.gradient[i] = to_float(normalized(inside ? way : -way));
            if (values.closest != nullptr) values.closest[i] = to_float(point + way);
            if (values.doubtful != nullptr) values.doubtful[i] = std::abs(winding - 0.5) <= 0.25;
        }
    }
    double distance(const DVec<3>& point) const override { return length(nearest(point)); }

private:
    DVec<3> nearest(const DVec<3>& point) const {
        DVec<3> best(0.0);
        double least = std::numeric_limits<double>::infinity();
        const Vec3 there = to_float(point);
        each_part_near(mesh_, {there, there}, [&](const Triangle3& t, std::uint32_t) {
            const DVec<3> way = way_to(DVec<3>(t.a) - point, DVec<3>(t.b) - point, DVec<3>(t.c) - point);
            if (dot(way, way) < least) {
                least = dot(way, way);
                best = way;
            }
            return static_cast<float>(std::sqrt(least) * (1 + 1e-6)) + 1e-6f * static_cast<float>(largest(point));
        });
        return best;
    }
    double winding_of(const DVec<3>& point) const {
        if (surface_.gaps == 0) return solid_contains(mesh_, to_float(point)) ? 1 : 0;
        double sum = 0;
        for (const glm::uvec3& t : surface_.mesh.triangles) {
            const auto& p = surface_.mesh.points;
            sum += solid_angle(DVec<3>(p[t.x]) - point, DVec<3>(p[t.y]) - point, DVec<3>(p[t.z]) - point);
        }
        return std::abs(sum / (4 * 3.14159265358979323846));
    }

    const FieldSurface& surface_;
    Mesh mesh_;
    SampleLattice<3> lattice_;
};

}  // namespace

Result<Field<3>> bake_field(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                            const FieldOptions<3>& options) {
    FieldWork work(options);
    if (!work.begin(0.1)) return FieldWork::cancelled();
    const Result<FieldSurface> surface = field_surface(points, triangles);
    if (!surface) return surface.problem();
    Result<FieldData<3>> grid = field_grid(surface->box, options);
    if (!grid) return grid.problem();
    std::vector<glm::uvec3> solid;
    for (const std::uint32_t i : surface->solid) solid.push_back(surface->mesh.triangles[i]);
    Result<Mesh> mesh = Mesh::build(surface->mesh.points, solid);
    if (!mesh) return mesh.problem();

    FieldReport report;
    report.closed = surface->gaps == 0;
    report.gaps = surface->gaps;
    report.rewound = surface->rewound;
    const MeshSource source(*surface, *mesh, lattice_of(*grid));
    Result<Field<3>> field = fill_field(*std::move(grid), source, options, work, report);
    if (field && options.report != nullptr) *options.report = report;
    return field;
}

Result<Field<3>> bake_field(const Mesh& mesh, const FieldOptions<3>& options) {
    return bake_field(mesh.points(), mesh.triangles(), options);
}

}  // namespace abut
