#pragma once

// Adjacency of the parts of a composite shape, for the internal-edge (ghost collision) filter.

#include <cstdint>

namespace abut {

// Sides are numbered by the part's kind. Segment: 0 at its first point, 1 at its second. Triangle: i is the edge from
// corner i to the next. Tile: 2 * axis, plus one at the low end, as the faces of a box.

/// A boundary edge: no part is adjacent.
inline constexpr std::uint32_t no_neighbour = 0xffffffffu;

/// A non-manifold edge: more than two parts share it.
inline constexpr std::uint32_t many_neighbours = 0xfffffffeu;

}  // namespace abut
