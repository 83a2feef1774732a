#pragma once

// The nearest points of two boxes that are apart, without a walk: a corner of one of them is nearest to the other box,
// or an edge of each to one another. What is found is proven by the plane between them.

#include <abut/convex/box_axes.hpp>
#include <abut/convex/box_meeting.hpp>

namespace abut {

/// The nearest points of A and of a corner of B, or of another that leads on from it. False where nothing is proven: no
/// corner of B is nearest, or another one is.
bool nearest_from_corner(const BoxFrame& frame, std::uint32_t corner_of_b, BoxMeeting& meeting);

/// The same, of whichever corner of either is nearest to the other box.
bool nearest_corner(const BoxFrame& frame, BoxMeeting& meeting);

/// The edges of either along the axis between edges of that number, which parts the boxes, or lets them overlap, by
/// `meeting.distance`. False where they don't pass one another within their ends.
bool meeting_edges(const BoxFrame& frame, std::size_t number, BoxMeeting& meeting);

}  // namespace abut
