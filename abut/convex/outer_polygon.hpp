#pragma once

// A convex polygon of few edges around another.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

/// The corners of a convex polygon of `count` edges, 3 or more, around a loop of more corners (counter-clockwise, no
/// three on a line), of nearly the least area, in double. Edges are taken out, the least area first, and the neighbours
/// of each then meet; the last ones of a dozen or fewer are
/// the best choice of 32. After that every edge in turn is put to where the area is least: along an edge of the loop,
/// or where it touches a corner with its middle (Klee, Laskowski: "Finding the smallest triangles containing a given
/// convex polygon", 1985). n log n.
std::vector<DVec<2>> outer_polygon(std::span<const DVec<2>> loop, std::size_t count);

}  // namespace abut
