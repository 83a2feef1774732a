#pragma once

// A convex polygon of few edges around another one.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut::detail {

/// The corners of a convex polygon of `count` edges, 3 or more, around a loop of more corners (counter-clockwise, no
/// three collinear), of nearly the minimum area, in double. Edges are removed, the smallest added area first, and the
/// neighbours are extended to their intersection; for a dozen edges or fewer the last step is the optimum among 32.
/// Then every edge in turn moves to the minimum area: along an edge of the loop, or touching a corner with its midpoint
/// (Klee, Laskowski: "Finding the smallest triangles containing a given convex polygon", 1985). O(n log n).
std::vector<DVec<2>> outer_polygon(std::span<const DVec<2>> loop, std::size_t count);

}  // namespace abut::detail
