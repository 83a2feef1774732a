#pragma once

// GJK in haste: between two cores of corners, in the frame of A, with the plainest arithmetic there is, and compiled
// whole for each kind of vector unit. It keeps to what is certain: a gap whose two bounds agree, an axis or a simplex
// that decides by far more than rounding. All else is left to the careful walk.

#include <abut/convex/search_options.hpp>
#include <abut/convex/support.hpp>

namespace abut {

/// Where a quick walk begins, and where it ended: corners of A and B by number, two and two a point of A - B.
struct QuickSimplex {
    std::array<std::uint32_t, 4> corner_a{}, corner_b{};
    std::uint32_t count = 0;
    DVec<3> toward{0.0};  ///< from A to B: to begin with, where to look without corners, or zero where nothing is
                          ///< known; in the end as long as they are apart
};

/// Where they are nearest, as far as a walk could tell: right where both bounds are nearly the same.
struct QuickGap {
    double reached = 0;  ///< the distance of a point of A from a point of B
    double proven = -1;  ///< the width of a slab between them
    DVec<3> on_a{0.0};
};

enum class QuickExit : std::uint8_t {
    apart,        ///< `toward` parts them by more than `enough`, by far more than rounding
    overlapping,  ///< the origin is inside the simplex, by far more than rounding
    stopped,      ///< nothing nearer to the origin was found
    lost,         ///< too near to it to tell
};

/// Whether it takes these cores: both of corners and not stretched, not both of them boxes.
bool quick_to_walk(const Convex<3>& a, const Convex<3>& b);

/// Walks until nothing of A - B is nearer to the origin. There is a gap where it stopped.
QuickExit quick_gap(const Convex<3>& a, const Convex<3>& b, QuickSimplex& simplex, QuickGap& gap, Trace<3>* trace);

/// Walks until it is certain whether they are farther apart than `enough`, or can't be.
QuickExit quick_decision(const Convex<3>& a, const Convex<3>& b, double enough, QuickSimplex& simplex, Trace<3>* trace);

}  // namespace abut
