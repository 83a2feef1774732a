#pragma once

// Convex polygons of few edges around another one.

#include <abut/math/affine.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut::detail {

/// The corners, counter-clockwise.
using Loop2 = std::vector<DVec<2>>;

double area_of(std::span<const DVec<2>> loop);

/// Convex polygons of at most `count` edges, 3 or more, around a loop of size about 1 with more corners
/// (counter-clockwise, no three collinear), of nearly the minimum area, in double; the smallest first, which is at most
/// as large as the minimum oriented rectangle after the map `seen`, or twice that for 3 edges. One is what is left when
/// edges are removed, the smallest added area first, and the neighbours are extended to their intersection. Another is
/// the rectangle, or the triangle around it. In each, every edge in turn moves to the minimum area: along an edge of
/// the loop, or touching a corner with its midpoint (Klee, Laskowski: "Finding the smallest triangles containing a
/// given convex polygon", 1985). O(n log n).
std::vector<Loop2> outer_polygons(std::span<const DVec<2>> loop, std::size_t count, const Affine<2>& seen = {});

}  // namespace abut::detail
