#pragma once

// The closest features of two disjoint polygons, from any features near them.
//
// The steps are those of V-Clip (Mirtich 1998) in 2D. From two corners, or an edge and a corner, each step goes to the
// feature whose Voronoi region contains the other, until each lies in the region of the other. That proves the
// distance: the line through the two points is a normal of both. The region tests of vertices use the normals of the
// two edges, which are exact to the last digit, not differences of corners.

#include <abut/convex/polygon_soa.hpp>

namespace abut::detail {

/// Two closest corners, or an edge of one polygon and a corner of the other.
struct FeaturePair {
    std::array<std::uint32_t, 2> corners;  ///< of A and of B
    bool is_edge;
    std::uint32_t of, side;  ///< the polygon of the edge. 0: A; 1: B
};

/// From two corners. `seen[0]` is B relative to A, `seen[1]` A relative to B. Returns false if the polygons overlap, or
/// the steps cycle on rounding.
bool walk_to_closest(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&seen)[2], FeaturePair& features);

}  // namespace abut::detail
