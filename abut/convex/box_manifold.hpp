#pragma once

// The contact points of two boxes.

#include <abut/convex/box_meeting.hpp>
#include <abut/convex/manifold.hpp>

namespace abut {

/// As `manifold`, of boxes that meet as told. Names are its own: the same while the same corners and edges meet and
/// the face of the same box is looked at. Of a meeting along the normal of a face the place needn't be known: it is
/// written to `on_a`, in the world, where that isn't null. False, and the points are of no use, where it isn't found.
bool manifold_of_boxes(const BoxPlacement& a, const BoxPlacement& b, const BoxFrame& frame, const BoxMeeting& meeting,
                       double margin, DVec<3>* on_a, Manifold<3>& points);

}  // namespace abut
