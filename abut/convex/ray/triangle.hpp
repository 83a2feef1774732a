#pragma once

// Ray against triangle, inline for the triangle loops of meshes. For .cpp files.

#include <abut/convex/ray/closed_forms.hpp>
#include <abut/convex/tolerance.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {

/// A ray that starts nearer to the line or plane of a thin part, relative to the coordinates, may be leaving it.
inline constexpr double ray_start_tolerance = sixteen_ulp;

/// A ray that passes an edge nearer than this, relative to the coordinates, may hit it: neighbours leave no crack.
inline constexpr double ray_edge_tolerance = 1e-12;

/// A ray with a smaller slope to a plane or line grazes it.
inline constexpr double ray_grazing_slope = 1e-6;

/// Whether a grazing ray surely misses the line or plane.
inline bool surely_misses_plane(double height, double scale) {
    return height > 4 * (ray_tolerance + ray_grazing_slope) * scale;
}

/// The largest absolute coordinate.
[[gnu::always_inline]] inline double largest_of_three(const DVec<3>& v) {
    return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

/// The corners are relative to the ray's origin. Sets `entry` if the ray enters.
[[gnu::always_inline]] inline RayAnswer decide_triangle(const DVec<3>& direction, double max_length, const DVec<3>& a,
                                                        const DVec<3>& b, const DVec<3>& c, RayEntry<3>& entry) {
    const DVec<3> ab = b - a, ac = c - a, normal = cross(ab, ac);
    const double height = -dot(a, normal), descent = -dot(direction, normal);
    // How far the line passes outside of the edges through `a`, and of the third, in areas.
    const DVec<3> rotated = cross(direction, a);
    const double side = std::copysign(1.0, descent), whole = std::abs(descent);
    const double to_ac = side * dot(ac, rotated), to_ab = -side * dot(ab, rotated);
    const double beyond = std::max(std::max(-to_ac, -to_ab), to_ac + to_ab - whole);
    const double size = largest_of_three(ab) + largest_of_three(ac), scale = largest_of_three(a) + size;
    const double area = square_root(dot(normal, normal));
    if (!(area > 1e-6 * size * size)) return RayAnswer::undecided;
    if (whole <= ray_grazing_slope * area)
        return surely_misses_plane(std::abs(height) / area, scale) ? RayAnswer::misses : RayAnswer::undecided;
    if (beyond > ray_edge_tolerance * scale * size) return RayAnswer::misses;
    if (std::abs(height) <= ray_start_tolerance * scale * area) return RayAnswer::undecided;
    const double along = height / descent;
    if (along < 0 || along > max_length) return RayAnswer::misses;
    // For a grazing ray, or past a sharp corner, a small distance outside of the edges may be a large one in space.
    if (whole < 1e-3 * area || (beyond > 0 && area < 1e-3 * size * size)) return RayAnswer::undecided;
    entry.along = along;
    entry.normal = normal * side;
    entry.kind = FeatureKind::face;
    entry.index = descent > 0 ? 0u : 1u;
    return RayAnswer::enters;
}

}  // namespace abut::detail
