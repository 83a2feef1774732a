#pragma once

// How far the sides of two polygons part them: all sides at once, in as many lanes as the machine has.

#include <abut/convex/sides.hpp>

namespace abut {

/// The side with the widest gap in front of it, and the corner of the other that is nearest to its line.
struct SideGap {
    double gap;        ///< below zero: the least depth along any side's normal
    std::uint32_t of;  ///< 0: a side of A; 1: of B
    std::uint32_t side;
    std::uint32_t corner;  ///< of the other; where several are as near, the first
};

/// Of the sides of A and B, those of A first among those that part them equally, to within `doubt`. `seen[0]` is B as
/// seen from A, `seen[1]` A as seen from B. Where A's sides leave a gap wider than `enough`, B's aren't looked at.
void widest_gap(const Sides& a, const Sides& b, const Rigid2 (&seen)[2], double enough, double doubt, SideGap& result);

/// The same of two boxes, by what they reach from their middles.
void gap_of_boxes(const DVec<2>& a, const DVec<2>& b, const Rigid2 (&seen)[2], double doubt, SideGap& result);

}  // namespace abut
