#pragma once

// Triangles that a surface is better off without.

#include <abut/bake/weld.hpp>

#include <cstddef>

namespace abut {

/// Of triangles with the same three corners the first stays, of those wound the way most of them are. Where as many are
/// wound one way as the other, they are a wall that is seen from both sides: walls that only part what is closed
/// without them, as between two boxes that touch, go altogether; of others one triangle stays. Points are welded.
/// Returns how many went. O(n log n).
std::size_t drop_doubles(Welded& surface);

/// Takes out triangles without area and keeps the surface together: the neighbour at the longest edge is cut in two at
/// the corner that lies on it. Where no neighbour can be cut, the triangle just goes; so it does where one cut would
/// lead to the next for 64 times. Returns how many went.
std::size_t drop_slivers(Welded& surface);

}  // namespace abut
