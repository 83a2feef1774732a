#pragma once

// A box and a triangle in space: whether they overlap, and how deep, told by the separating axes that the two have.

#include <abut/convex/box_pair.hpp>
#include <abut/convex/round_pairs.hpp>

namespace abut {

/// Whether the answers below are for A and B. Balls around them are welcome.
inline bool are_box_and_triangle(const Convex<3>& a, const Convex<3>& b) {
    return is_plain_box(a) && has_volume(a.own[0]) && is_round_points(b, 3);
}

enum class BoxTriangle : std::uint8_t { apart, meeting, unknown };

/// Whether they have a point in common. Unknown for slivers, and where only the balls may meet.
BoxTriangle box_triangle_overlap(const Convex<3>& box, const Convex<3>& triangle);

/// The signed distance where they meet or, of a box and a triangle with no balls around them, all but touch; `apart`,
/// with nothing told, where they are farther apart than `reach`. Unknown where only a search can tell.
BoxTriangle box_triangle_distance(const Convex<3>& box, const Convex<3>& triangle, double reach,
                                  SignedDistance<3>& result);

}  // namespace abut
