#pragma once

// What is beyond a side of a part of a composite shape: how parts know that they meet in a seam.

#include <cstdint>

namespace abut {

// Sides are numbered by the part's kind. Of a segment: 0 at its first point, 1 at its second. Of a triangle: i is the
// edge from corner i to the next. Of a tile: 2 * axis, plus one at the low end, as the faces of a box.

/// The surface ends there.
inline constexpr std::uint32_t no_neighbour = 0xffffffffu;

/// More than two parts meet there, so that the surface isn't one there.
inline constexpr std::uint32_t many_neighbours = 0xfffffffeu;

}  // namespace abut
