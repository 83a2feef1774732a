#pragma once

// Triangles that a surface is better off without.

#include <abut/shape/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// Of triangles with the same three corners the first stays, of those wound the way most of them are. Where as many are
/// wound one way as the other, they are a wall that is seen from both sides: walls that only part what is closed
/// without them, as between two boxes that touch, go altogether; of others one triangle stays. Points are welded.
/// Returns how many went. O(n log n).
std::size_t drop_doubles(Welded& surface);

/// Triangles without area, and what became of them.
struct CutSlivers {
    std::size_t cut = 0;                 ///< gone, their neighbours being cut in two: the second half took their number
    std::vector<bool> left;              ///< one a triangle: still without area; no neighbour could be cut
    std::vector<std::uint32_t> part_of;  ///< one a triangle: the one that it was a part of, itself where it wasn't cut
};

/// Where a triangle has no area, the neighbour at its longest edge is cut in two at the corner that lies on it, so that
/// nothing opens. No triangle changes its number. One cut may lead to the next, 64 times at most.
CutSlivers cut_slivers(Welded& surface);

/// Cuts slivers, and takes out those that are left. Returns how many went.
std::size_t drop_slivers(Welded& surface);

}  // namespace abut
