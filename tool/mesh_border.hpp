#pragma once

// The edges of a surface that aren't shared by two triangles which turn alike.

#include "level_view.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace abut::tool {

/// An edge the way round in which one of its triangles has it.
struct BorderEdge {
    std::uint32_t from = 0, to = 0;
    std::uint32_t triangle = 0;

    /// The same for both ways.
    std::pair<std::uint32_t, std::uint32_t> ends() const { return {std::min(from, to), std::max(from, to)}; }
};

struct SharedEdge {
    std::uint32_t a = 0, b = 0;  ///< triangles, a < b
    bool turns_alike = true;     ///< the two go along the edge in opposite ways, as those of a surface do
};

struct EdgesOfSurface {
    std::vector<BorderEdge> border;   ///< of one triangle
    std::vector<SharedEdge> shared;   ///< of two
    std::vector<BorderEdge> crowded;  ///< of three or more, with more of them one way than the other; each edge once
    std::vector<std::uint32_t> triangles;  ///< those that were looked at: of several with the same corners, the first
};

/// In the order of their points and triangles. O(n log n).
EdgesOfSurface edges_of(const Surface<3>& surface);

/// The border where it is mended: of corners closer than the tolerance one is left, and edges are cut where a corner
/// lies on them.
struct MendedBorder {
    std::vector<BorderEdge> open;     ///< pieces with nothing beyond them
    std::vector<BorderEdge> cracked;  ///< pieces that lie on one another, of both sides
};

MendedBorder mended(const Surface<3>& surface, const std::vector<BorderEdge>& border, float tolerance);

}  // namespace abut::tool
