#pragma once

// The corners of the area in which two sets meet, one of them a point or a segment with a ball around it: those that
// `manifold` finds by clipping faces, by the few steps that are left of it.

#include <abut/convex/manifold.hpp>

namespace abut {

/// As `manifold`. False, and `result` is of no use, where the pair is not one of a point and any other, of two segments
/// or of a segment and a box of some width.
bool round_manifold(const Convex<3>& a, const Convex<3>& b, const SignedDistance<3>& distance, double margin,
                    Manifold<3>& result);

}  // namespace abut
