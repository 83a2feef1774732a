#pragma once

// Clean-up of a triangle surface: duplicate triangles and slivers.

#include <abut/shape/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut::detail {

/// Removes duplicates: of triangles with the same three corners, the first with the majority orientation is left. If
/// both orientations are equally frequent, the triangles are a two-sided wall. A wall that only divides a closed
/// volume, as between two touching boxes, is removed; of other walls one triangle is left. Points must be welded.
/// Returns the number of removed triangles. O(n log n).
std::size_t remove_duplicate_triangles(Welded& surface);

/// The result of flipping the edges of slivers (triangles of zero area).
struct SliverFlips {
    std::size_t flipped = 0;  ///< number of removed slivers; each now holds half of the neighbour that was divided
    std::vector<bool> left;   ///< for each triangle: still a sliver, since no neighbour could be divided
    std::vector<std::uint32_t>
        source;  ///< for each triangle: the triangle that it is a part of; itself if it wasn't flipped
};

/// Removes slivers by edge flips: the neighbour across the longest edge is divided at the vertex that lies on that
/// edge, so the surface stays closed. Triangles keep their indices. A flip may enable another one; there are at most 64
/// passes.
SliverFlips flip_slivers(Welded& surface);

/// Flips slivers and removes the remaining ones. Returns the number of removed triangles.
std::size_t remove_slivers(Welded& surface);

}  // namespace abut::detail
