// A ray against all points within a radius of a flat polygon: the union of a prism between two parallel copies of the
// polygon and of a capsule around each edge. And against all points within a radius of the sum of a segment and a
// segment or triangle: the union of such sets for its faces, if the ray starts outside.

#include <abut/convex/ray/closed_forms.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace abut::detail {
namespace {

using Corners = std::array<DVec<3>, 3>;

/// Between the two copies of the plane the ray can only come in through a capsule, and before the nearer copy not at
/// all. So the ray is followed to that copy, where it enters the prism or is outside of some edges. A ray that is
/// inside of an edge there crosses the plane through that edge within a radius of the edge's line. So it enters the
/// capsule of that edge only by an end, which is an end of another capsule too, and that capsule can be left out.
template <std::size_t count>
RayEntry<3> enter_rounded_face(const DRay<3>& ray, const std::array<DVec<3>, count>& corners, double radius) {
    std::array<DVec<3>, count> sides;
    double size = 0;
    for (std::size_t i = 0; i < count; ++i) {
        sides[i] = corners[(i + 1) % count] - corners[i];
        size = std::max(size, largest(sides[i]));
    }
    const DVec<3>& a = corners[0];
    const DVec<3> normal = cross(sides[0], sides[count - 1] * -1.0);
    const double area = length(normal);
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
    std::array<bool, count> inside;
    bool inside_all = true;
    for (std::size_t i = 0; i < count; ++i) {
        const DVec<3> out = cross(sides[i], up) * side;
        const double beyond = dot(out, there - corners[i]);
        const double least_beyond = beyond + std::min(dot(out, ray.direction) * depth, 0.0), clear = radius + tolerance;
        if (least_beyond > 0 && least_beyond * least_beyond > clear * clear * length_squared(sides[i]))
            return ray_misses<3>();
        inside[i] = beyond <= 0;
        inside_all = inside_all && inside[i];
    }
    if (inside_all) {
        if (along == 0) return {};
        return {RayAnswer::enters, along, up, FeatureKind::face, side > 0 ? 0u : 1u};
    }
    RayEntry<3> first = ray_misses<3>();
    for (std::uint32_t i = 0; i < count; ++i) {
        if (inside[i]) continue;
        const std::uint32_t next = i + 1 == count ? 0 : i + 1;
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

/// The parallelogram that a segment from -half to half sweeps along an edge. Its features are named as those of the
/// edge from corner i to j.
RayEntry<3> enter_swept_edge(const DRay<3>& ray, const Corners& corners, std::uint32_t i, std::uint32_t j,
                             const DVec<3>& half, double radius) {
    RayEntry<3> entry = enter_rounded_face<4>(
        ray, {corners[i] - half, corners[j] - half, corners[j] + half, corners[i] + half}, radius);
    const std::array<std::uint32_t, 4> numbers{i, j, j, i};
    std::uint32_t first = i, last = j;
    if (entry.kind == FeatureKind::vertex) first = last = numbers[entry.index];
    if (entry.kind == FeatureKind::edge) {
        first = numbers[entry.index & 0xffffu];
        last = numbers[entry.index >> 16];
    }
    entry.kind = first == last ? FeatureKind::vertex : FeatureKind::edge;
    entry.index = first == last ? first : edge_index(first, last);
    return entry;
}

/// The first entry into several sets. A ray that isn't certain about one is certain about none.
void take_first(const RayEntry<3>& entry, RayEntry<3>& first) {
    if (first.answer == RayAnswer::undecided || entry.answer == RayAnswer::misses) return;
    if (entry.answer == RayAnswer::undecided || first.answer == RayAnswer::misses || entry.along < first.along)
        first = entry;
}

/// A ray from outside enters by a face that it faces, or an edge or corner of one. If the segment lies nearly in the
/// plane of the triangle, it is uncertain which faces those are, and all are tested.
RayEntry<3> enter_swept_triangle(const DRay<3>& ray, const Corners& corners, DVec<3> half, double radius) {
    const DVec<3> normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double area = length(normal);
    double rise = dot(normal, half);
    if (rise < 0) {
        half = -half;
        rise = -rise;
    }
    const bool flat = !(rise > 1e-3 * area * length(half));
    bool starts_outside = false, misses = false;
    const auto faces = [&](const DVec<3>& out, const DVec<3>& point) {
        const double size = length(out), clear = radius + ray_tolerance * (largest(point) + radius);
        const bool before = -dot(point, out) > clear * size;
        starts_outside = starts_outside || before;
        if (dot(ray.direction, out) <= ray_tolerance * size) return true;
        misses = misses || before;
        return false;
    };
    std::array<bool, 5> may_enter;
    may_enter[3] = faces(normal, corners[0] + half);
    may_enter[4] = faces(-normal, corners[0] - half);
    for (std::uint32_t i = 0; i < 3; ++i) {
        const DVec<3> out = cross(corners[(i + 1) % 3] - corners[i], half);
        // Without an area it is part of its neighbours.
        may_enter[i] = flat ? length(out) > 1e-9 * area : faces(out, corners[i] - half);
    }
    RayEntry<3> first = ray_misses<3>();
    if (misses) return first;
    if (!starts_outside) return {};
    for (std::uint32_t i = 0; i < 3; ++i)
        if (may_enter[i]) take_first(enter_swept_edge(ray, corners, i, (i + 1) % 3, half, radius), first);
    for (std::uint32_t i = 3; i < 5; ++i) {
        const DVec<3> offset = i == 3 ? half : -half;
        if (may_enter[i])
            take_first(
                enter_rounded_face<3>(ray, {corners[0] + offset, corners[1] + offset, corners[2] + offset}, radius),
                first);
    }
    return first;
}

/// Where on the segment the contact is, from -1 to 1: at its point k - t half the sum is entered, with k in the
/// feature.
double segment_part(const RayEntry<3>& entry, const Corners& corners, const DVec<3>& half, const DVec<3>& core_point) {
    if (entry.kind == FeatureKind::face) {
        const DVec<3> normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
        return dot(core_point - corners[0], normal) * dot(half, normal) > 0 ? -1 : 1;
    }
    const bool is_edge = entry.kind == FeatureKind::edge;
    const DVec<3>& start = corners[is_edge ? entry.index & 0xffffu : entry.index];
    DVec<3> across = half;
    if (is_edge) {
        const DVec<3> edge = corners[entry.index >> 16] - start;
        if (const double squared = length_squared(edge); squared > 0) across -= edge * (dot(edge, half) / squared);
    }
    // The ends of a segment may be the same point.
    const double squared = length_squared(across);
    return squared > 0 ? std::clamp(-dot(core_point - start, across) / squared, -1.0, 1.0) : 0;
}

}  // namespace

RayEntry<3> enter_rounded_triangle(const DRay<3>& ray, const Corners& corners, double radius) {
    return enter_rounded_face(ray, corners, radius);
}

RayEntry<3> enter_rounded_sum(const DRay<3>& ray, const Corners& corners, std::uint32_t count, const DVec<3>& half,
                              double radius, double& part) {
    const RayEntry<3> result = count == 2 ? enter_swept_edge(ray, corners, 0, 1, half, radius)
                                          : enter_swept_triangle(ray, corners, half, radius);
    if (result.answer == RayAnswer::enters)
        part = segment_part(result, corners, half, ray.direction * result.along - normalized(result.normal) * radius);
    return result;
}

}  // namespace abut::detail
