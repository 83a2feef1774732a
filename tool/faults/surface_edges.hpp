#pragma once

// Classifies the edges of a surface: boundary, shared and non-manifold edges.

#include "tool/objects/level_view.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace abut::tool {

/// A directed edge of a triangle.
struct BoundaryEdge {
    std::uint32_t from = 0, to = 0;
    std::uint32_t triangle = 0;

    /// The sorted vertices: equal for both directions.
    std::pair<std::uint32_t, std::uint32_t> ends() const { return {std::min(from, to), std::max(from, to)}; }
};

struct SharedEdge {
    std::uint32_t a = 0, b = 0;  ///< triangles, a < b
    bool is_consistent =
        true;  ///< the triangles are oriented consistently: they traverse the edge in opposite directions
};

struct SurfaceEdges {
    std::vector<BoundaryEdge> boundary;  ///< of one triangle
    std::vector<SharedEdge> shared;      ///< of two triangles
    std::vector<BoundaryEdge>
        non_manifold;  ///< of three or more triangles that don't pair up by direction; each edge once
    std::vector<std::uint32_t> triangles;  ///< triangles classified: one of each set with the same vertices, the first
};

/// Classifies all edges, sorted by vertices and triangles. Takes O(n log n) time.
SurfaceEdges edges_of(const Surface<3>& surface);

/// The boundary after welding: vertices closer than the tolerance are merged, and edges are split at vertices on them.
struct WeldedBoundary {
    std::vector<BoundaryEdge> open;     ///< segments without a counterpart
    std::vector<BoundaryEdge> cracked;  ///< segments that coincide, of both sides
};

WeldedBoundary weld_boundary(const Surface<3>& surface, const std::vector<BoundaryEdge>& boundary, float tolerance);

}  // namespace abut::tool
