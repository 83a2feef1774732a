#pragma once

// Where a beam goes through a triangle, written where it is wanted: a mesh asks it of its triangles one after the
// other, in the middle of a search. For .cpp files.

#include <abut/convex/margin.hpp>
#include <abut/convex/ray_forms.hpp>

#include <algorithm>
#include <cmath>

namespace abut {

/// A beam that starts so near to the line or plane of a thin part, in parts of the numbers seen, may be leaving it.
inline constexpr double ray_start_doubt = sixteen_ulp;

/// A beam that passes an edge so near, in parts of the numbers seen, may meet it: neighbours leave no crack.
inline constexpr double ray_edge_doubt = 1e-12;

/// A beam that goes along a plane or line but for this slope skims it.
inline constexpr double ray_skims = 1e-6;

/// Of a line or plane that the beam skims: whether it surely stays clear of it.
inline bool ray_stays_clear(double height, double scale) {
    return height > 4 * (ray_doubt + ray_skims) * scale;
}

/// The corners as seen from the beam's origin. Writes to `entry` where it is decided.
[[gnu::always_inline]] inline RayAnswer decide_triangle(const DVec<3>& direction, double most, const DVec<3>& a,
                                                        const DVec<3>& b, const DVec<3>& c, RayEntry<3>& entry) {
    const DVec<3> ab = b - a, ac = c - a, normal = cross(ab, ac);
    const double size = largest(ab) + largest(ac), scale = largest(a) + size;
    const double area = length(normal);
    if (!(area > 1e-6 * size * size)) return RayAnswer::undecided;
    const double height = -dot(a, normal), sinks = -dot(direction, normal);
    if (std::abs(sinks) <= ray_skims * area)
        return ray_stays_clear(std::abs(height) / area, scale) ? RayAnswer::misses : RayAnswer::undecided;
    // How far the line passes from the edges through `a` and then from the third, in areas.
    const DVec<3> turned = cross(direction, a);
    const double side = sinks > 0 ? 1 : -1;
    const double to_ac = side * dot(ac, turned), to_ab = -side * dot(ab, turned), whole = side * sinks;
    const double beyond = std::max({-to_ac, -to_ab, to_ac + to_ab - whole});
    if (beyond > ray_edge_doubt * scale * size) return RayAnswer::misses;
    if (std::abs(height) <= ray_start_doubt * scale * area) return RayAnswer::undecided;
    const double along = height / sinks;
    if (along < 0 || along > most) return RayAnswer::misses;
    // Where it skims, or past a sharp corner, a little outside of the edges may be far.
    if (whole < 1e-3 * area || (beyond > 0 && area < 1e-3 * size * size)) return RayAnswer::undecided;
    entry.along = along;
    entry.normal = normal * side;
    entry.kind = FeatureKind::face;
    entry.index = sinks > 0 ? 0u : 1u;
    return RayAnswer::enters;
}

}  // namespace abut
