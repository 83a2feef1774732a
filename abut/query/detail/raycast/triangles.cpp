#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/raycast/by_advance.hpp>
#include <abut/shape/mesh/rays.hpp>

namespace abut::detail {

namespace {

/// Whether the composite has no pose: its local frame is the world's.
bool is_unplaced(const Composite<3>& composite) {
    return composite.place.column == Affine<3>::identity() && composite.place.offset == DVec<3>(0.0);
}

/// A composite in the frame of its triangles, for one ray.
struct Target {
    const DRay<3>& beam;
    Ray3 local{};
    Affine<3> placement{};
    bool placed = false, similar = true;
    double unit = 1, origin_error = 0, wanted_side = 0;

    MeshRay mesh_beam() const {
        return {beam, {local, origin_error, wanted_side, similar}, unit, placed ? &placement : nullptr};
    }
};

/// A bound on the error from transforming a ray to the local frame of a shape and its corners back: a few roundings of
/// all numbers involved.
double placement_error_of(const Composite<3>& composite, const Affine<3>& back, const DVec<3>& origin) {
    const DVec<3> extent = DVec<3>(composite.bounds.max) - DVec<3>(composite.bounds.min);
    double result = 1e-13 * (largest(origin) + largest(extent));
    if (composite.similar) return result;
    // The search accepts a hit slightly beside a triangle, relative to its size in the world. A stretched triangle may
    // be large along another axis than the one of that error.
    double squares = 0;
    for (std::size_t i = 0; i < 3; ++i)
        squares += length_squared(back.column[i]) * length_squared(composite.place.column[i]);
    return result + 2e-7 * square_root(squares) * largest(extent);
}

/// Returns false if the shape isn't known by its triangles, or its numbers exceed the range of floats.
bool set_target(const Composite<3>& composite, const QueryOptions<3>& options, Target& target) {
    const bool thin = composite.radius == 0 && composite.inner_radius == 0;
    if (composite.triangles == nullptr || !thin) return false;
    target.wanted_side = options.back_faces ? 0 : 1;
    const DRay<3>& beam = target.beam;
    target.origin_error = 0x1p-24 * largest(beam.origin);
    if (is_unplaced(composite)) {
        target.local = {to_float(beam.origin), to_float(beam.direction), static_cast<float>(beam.length)};
        return true;
    }
    const double volume = determinant(composite.place);
    if (volume == 0) return false;
    if (volume < 0) target.wanted_side = -target.wanted_side;
    target.placed = true;
    target.placement = composite.place;
    target.placement.offset -= beam.origin;
    const Affine<3> back = inverse(composite.place, volume);
    if (beam.rests()) return true;
    const DVec<3> along = back.vector(beam.direction);
    target.unit = length(along);
    if (!(target.unit > 1e-30 && target.unit < 1e30)) return false;
    const DVec<3> origin = back.point(beam.origin);
    target.local = {to_float(origin), to_float(along / target.unit), static_cast<float>(beam.length * target.unit)};
    target.origin_error = placement_error_of(composite, back, origin) + 0x1p-24 * largest(origin);
    target.similar = composite.similar;
    return true;
}

/// The triangles of a composite.
auto parts_of(const Composite<3>& composite) {
    return [&composite](const Triangle3& triangle) { return placed(convex(triangle), composite); };
}

PartHit<3> part_hit(const RayEntry<3>& entry, std::uint32_t triangle) {
    return {entry.along, entry.normal, false, {triangle, entry.index, entry.kind}};
}

}  // namespace

// A ray without direction hits no triangle: it leaves the one that it starts on.

bool first_triangle_hit(const DRay<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options,
                        PartHit<3>& first, bool& found) {
    Target target{beam};
    if (!set_target(composite, options, target)) return false;
    if (beam.rests()) return true;
    const auto undecided = by_advance(beam, parts_of(composite), options.trace);
    MeshHit hit;
    if (!find_first_hit(*composite.triangles, target.mesh_beam(), RobustTriangleTest(undecided), hit)) return false;
    found = hit.triangle != nullptr;
    if (found) first = part_hit(hit.entry, *hit.triangle);
    return true;
}

bool any_triangle_hit(const DRay<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options, bool& found) {
    Target target{beam};
    if (!set_target(composite, options, target)) return false;
    if (beam.rests()) return true;
    const auto undecided = by_advance(beam, parts_of(composite), options.trace);
    return find_any_hit(*composite.triangles, target.mesh_beam(), RobustTriangleTest(undecided), found);
}

bool each_triangle_hit(const DRay<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options,
                       HitVisitor visit) {
    Target target{beam};
    if (!set_target(composite, options, target)) return false;
    if (beam.rests()) return true;
    const auto undecided = by_advance(beam, parts_of(composite), options.trace);
    const auto report = [&](const RayEntry<3>& entry, std::uint32_t triangle) {
        return visit(part_hit(entry, triangle));
    };
    return find_each_hit(*composite.triangles, target.mesh_beam(), RobustTriangleTest(undecided), MeshHitCall(report));
}

}  // namespace abut::detail
