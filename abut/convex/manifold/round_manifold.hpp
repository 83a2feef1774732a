#pragma once

// The contact manifold of two sets, one of them a point or a segment with a ball around it: the clipping of `manifold`
// in closed form.

#include <abut/convex/manifold/manifold.hpp>

namespace abut::detail {

/// As `manifold`. Returns false, with `result` undefined, unless the pair is a point and any other, two segments, or a
/// segment and a box, triangle or polyhedron that isn't too thin.
bool round_manifold(const Convex<3>& a, const Convex<3>& b, const SignedDistance<3>& distance, double margin,
                    Manifold<3>& result);

}  // namespace abut::detail
