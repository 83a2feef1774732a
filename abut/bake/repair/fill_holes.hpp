#pragma once

// Fills the holes of a surface with triangles.

#include <abut/bake/repair/orientation.hpp>

#include <cstddef>
#include <cstdint>

namespace abut::detail {

struct FilledHoles {
    std::size_t holes = 0;
    std::size_t triangles = 0;
};

/// Fills each loop of at most `max_edges` open edges with its triangulation of minimum area (Barequet and Sharir,
/// "Filling gaps in the boundary of a polyhedron", 1995). The hole stays open if this area exceeds `max_area` times
/// that of the patch around it.
///
/// New triangles are oriented like their neighbours. They add no vertices and no edge that the surface already has;
/// those that close a crack may have no area. Loops that touch themselves are filled piece by piece. Points are welded,
/// triangles oriented consistently. O(n log n + k^3) for loops of k edges.
FilledHoles fill_holes(Welded& surface, Patches& patches, std::uint32_t max_edges, double max_area);

}  // namespace abut::detail
