#pragma once

// Holes in a surface, closed with triangles.

#include <abut/bake/wind.hpp>

#include <cstddef>
#include <cstdint>

namespace abut {

struct FilledHoles {
    std::size_t holes = 0;
    std::size_t triangles = 0;
};

/// Closes each loop of open edges that has at most `most_edges`, with the triangulation of least area (Barequet and
/// Sharir, "Filling gaps in the boundary of a polyhedron", 1995) where that area is at most `most_area` of that of the
/// patch around it. New triangles turn the way their neighbours do, have no new corners and no edge that the surface
/// has already; they may have no area, where a crack is closed. Loops that touch themselves are closed piece by piece.
/// Points are welded, triangles wound alike. O(n log n + k^3) for loops of k edges.
FilledHoles fill_holes(Welded& surface, Patches& patches, std::uint32_t most_edges, double most_area);

}  // namespace abut
