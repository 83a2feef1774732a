#pragma once

// The contact manifold of two sets, one of them a point or a segment with a ball around it: the clipping of `manifold`
// in closed form.

#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/placed_cores.hpp>

namespace abut::detail {

/// As `manifold`. Returns false, with `result` undefined, unless the pair is a point and any other, two segments, or a
/// segment and a box, triangle or polyhedron that isn't too thin.
bool round_manifold(const Convex<3>& a, const Convex<3>& b, const SignedDistance<3>& distance, double margin,
                    Manifold<3>& result);

// The same of placed cores. Two boxes have no closed form here.

bool core_manifold(const PlacedSegment& a, const PlacedSegment& b, const SignedDistance<3>& distance, double margin,
                   Manifold<3>& result);
bool core_manifold(const PlacedBox& a, const PlacedSegment& b, const SignedDistance<3>& distance, double margin,
                   Manifold<3>& result);
bool core_manifold(const PlacedSegment& a, const PlacedBox& b, const SignedDistance<3>& distance, double margin,
                   Manifold<3>& result);
bool core_manifold(const PlacedBox& a, const PlacedBox& b, const SignedDistance<3>& distance, double margin,
                   Manifold<3>& result);

/// The one contact point of a ball and any other.
bool deepest_point(const SignedDistance<3>& distance, Manifold<3>& result);

template <class A, class B>
bool core_manifold(const A&, const B&, const SignedDistance<3>& distance, double, Manifold<3>& result) {
    static_assert(std::is_same_v<A, PlacedBall> || std::is_same_v<B, PlacedBall>);
    return deepest_point(distance, result);
}

}  // namespace abut::detail
