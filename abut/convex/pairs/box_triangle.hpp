#pragma once

// Overlap and penetration depth of a box and a triangle in 3D, by their separating axes.

#include <abut/convex/pairs/pair_answer.hpp>
#include <abut/convex/pairs/round3.hpp>

namespace abut::detail {

/// Whether a box isn't nearly flat. Flat boxes take the general algorithms.
inline bool has_volume(const Vec3& half) {
    const float longest = std::max(std::max(half.x, half.y), half.z),
                shortest = std::min(std::min(half.x, half.y), half.z);
    return shortest > 1e-4f * longest;
}

/// Whether the functions below take A and B. Both may have balls around them.
inline bool are_box_and_triangle(const Convex<3>& a, const Convex<3>& b) {
    return is_plain_box(a) && has_volume(a.own[0]) && is_round_points(b, 3);
}

/// Whether they share a point. Unknown for slivers, and if only the balls may overlap.
PairAnswer box_triangle_overlap(const Convex<3>& box, const Convex<3>& triangle);

/// The signed distance if they overlap or, without balls, nearly touch. Returns `no` without a result if the
/// distance is above `reach`, and `unknown` if only the general algorithms can decide.
PairAnswer box_triangle_distance(const Convex<3>& box, const Convex<3>& triangle, double reach,
                                 SignedDistance<3>& result);

}  // namespace abut::detail
