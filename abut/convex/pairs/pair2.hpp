#pragma once

// Closed forms in 2D: circles, capsules, segments, triangles, boxes and polygons of few edges, each against each. They
// return what `signed_distance` and `manifold` return, or `unknown`.

#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/polygon2.hpp>

namespace abut::detail {

using PairAnswer2 = PolygonPair::Answer;

/// Whether the distance of two shapes is at most `reach`.
PairAnswer2 pair2_within(const PlacedPolygon& a, const PlacedPolygon& b, double reach, Cache* cache);

/// The signed distance, unless it is unknown.
PairAnswer2 pair2_distance(const PlacedPolygon& a, const PlacedPolygon& b, Cache* cache, SignedDistance<2>& distance);

/// The contact if the distance is at most `reach`; its points have gaps of at most `margin`.
PairAnswer2 pair2_contact(const PlacedPolygon& a, const PlacedPolygon& b, double reach, double margin, Cache* cache,
                          SignedDistance<2>& distance, Manifold<2>& manifold);

}  // namespace abut::detail
