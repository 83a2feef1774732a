// A ray against all points within a radius of a triangle: the union of a prism between two parallel copies of the
// triangle and of a capsule around each edge.

#include <abut/convex/ray/closed_forms.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {

/// Between the two copies of the plane the ray can only come in through a capsule, and before the nearer copy not at
/// all. So the ray is followed to that copy, where it enters the prism or is outside of some edges. A ray that is
/// inside of an edge there crosses the plane through that edge within a radius of the edge's line. So it enters the
/// capsule of that edge only by an end, which is an end of another capsule too, and that capsule can be left out.
RayEntry<3> enter_rounded_triangle(const DRay<3>& ray, const std::array<DVec<3>, 3>& corners, double radius) {
    const auto& [a, b, c] = corners;
    const DVec<3> normal = cross(b - a, c - a);
    const double size = std::max({largest(b - a), largest(c - a), largest(c - b)}), area = length(normal);
    if (!(area > 1e-6 * size * size)) return {};
    const double side = dot(a, normal) <= 0 ? 1 : -1, inverse_area = side / area;
    const DVec<3> up = normal * inverse_area;
    const double height = -dot(a, up), descent = -dot(ray.direction, up);
    const double tolerance = ray_tolerance * (largest(a) + size + radius);

    double along = 0;  // to the nearer copy of the plane
    if (height > radius + tolerance) {
        if (descent <= 0) return ray_misses<3>();
        along = (height - radius) / descent;
        if (along > ray.length) return ray_misses<3>();
    }
    const DVec<3> there = ray.direction * along;
    // From there until the ray leaves the other copy of the plane, at most.
    const double depth = descent > 0 ? std::min((height + radius) / descent, ray.length) - along : ray.length - along;
    const std::array<DVec<3>, 3> sides{b - a, c - b, a - c};
    std::array<bool, 3> inside;
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec<3> out = cross(sides[i], up) * side;
        const double beyond = dot(out, there - corners[i]);
        const double least_beyond = beyond + std::min(dot(out, ray.direction) * depth, 0.0), clear = radius + tolerance;
        if (least_beyond > 0 && least_beyond * least_beyond > clear * clear * length_squared(sides[i]))
            return ray_misses<3>();
        inside[i] = beyond <= 0;
    }
    if (inside[0] && inside[1] && inside[2]) {
        if (along == 0) return {};
        return {RayAnswer::enters, along, up, FeatureKind::face, side > 0 ? 0u : 1u};
    }
    RayEntry<3> first = ray_misses<3>();
    for (std::uint32_t i = 0; i < 3; ++i) {
        if (inside[i]) continue;
        const std::uint32_t next = i == 2 ? 0 : i + 1;
        RayEntry<3> entry = enter_capsule(ray, corners[i], corners[next], radius);
        if (entry.answer == RayAnswer::undecided) return entry;
        if (entry.answer == RayAnswer::misses || (first.answer == RayAnswer::enters && entry.along >= first.along))
            continue;
        first = entry;
        if (entry.kind == FeatureKind::vertex)
            first.index = entry.index == 0 ? i : next;
        else
            first.index = edge_index(i, next);
    }
    return first;
}

}  // namespace abut::detail
