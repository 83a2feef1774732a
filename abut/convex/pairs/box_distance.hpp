#pragma once

// The closest points of two disjoint boxes in closed form: a vertex of one box and the other box, or an edge of each.
// The plane between the points proves the result.

#include <abut/convex/pairs/box_axes.hpp>
#include <abut/convex/pairs/box_closest.hpp>

namespace abut::detail {

/// The closest points of A and of a vertex of B, or of the vertex that it leads on to. Returns false if nothing is
/// proven: another vertex, or none, is closest.
bool nearest_from_corner(const BoxFrame& frame, std::uint32_t corner_of_b, BoxClosest& closest);

/// The closest points of the nearest vertex of either box and the other box.
bool nearest_corner(const BoxFrame& frame, BoxClosest& closest);

/// The closest points of the two edges of an edge axis, with the separation or overlap along it in `closest.distance`.
/// Returns false if the edges don't cross within their ends.
bool closest_on_edges(const BoxFrame& frame, std::size_t number, BoxClosest& closest);

}  // namespace abut::detail
