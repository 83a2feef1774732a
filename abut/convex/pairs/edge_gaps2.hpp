#pragma once

// Separating axes of two polygons: the gaps in front of all edges, evaluated in SIMD.

#include <abut/convex/polygon_soa.hpp>

namespace abut::detail {

/// The edge with the widest gap in front of it, and the corner of the other polygon that is nearest to its line.
struct EdgeGap {
    double gap;        ///< below zero: minus the minimum depth along any edge normal
    std::uint32_t of;  ///< the polygon of the edge. 0: A; 1: B
    std::uint32_t side;
    std::uint32_t corner;  ///< of the other polygon; the first of several
};

/// The widest gap of all edges of A and B. An edge of A wins a tie to within `tolerance`. `seen[0]` is B relative to A,
/// `seen[1]` A relative to B. If an edge of A has a gap wider than `max_distance`, B's edges aren't tested.
void widest_edge_gap(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&seen)[2], double max_distance,
                     double tolerance, EdgeGap& result);

/// The widest gap of two boxes, in closed form.
void gap_of_boxes(const DVec<2>& a, const DVec<2>& b, const Rigid2 (&seen)[2], double tolerance, EdgeGap& result);

}  // namespace abut::detail
