#pragma once

// The contact manifold of two polygons of few edges, from their closest features.

#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/polygon2.hpp>

namespace abut::detail {

/// As `manifold`, for polygons with balls around them. The result is written in place: a copy right after the writes
/// would stall.
void set_polygon_manifold(const PolygonPair& pair, const ClosestFeatures2& closest, const SignedDistance<2>& distance,
                          double margin, Manifold<2>& result);

}  // namespace abut::detail
