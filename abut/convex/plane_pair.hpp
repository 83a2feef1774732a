#pragma once

// The quick ways of the plane: circles, capsules, segments, triangles, boxes and polygons of few sides, each against
// each, by their outlines. They give what `signed_distance` and `manifold` give, or say that they don't know.

#include <abut/convex/manifold.hpp>
#include <abut/convex/polygon_pair.hpp>

namespace abut {

using PlaneAnswer = PolygonPair::Answer;

/// Whether two shapes are at most `reach` apart.
PlaneAnswer plane_near(const Outline& a, const Outline& b, double reach, Cache* cache);

/// How far apart, where that is known.
PlaneAnswer plane_distance(const Outline& a, const Outline& b, Cache* cache, SignedDistance<2>& distance);

/// Where they meet, if they are at most `reach` apart; of the points those at most `margin` apart.
PlaneAnswer plane_contact(const Outline& a, const Outline& b, double reach, double margin, Cache* cache,
                          SignedDistance<2>& distance, Manifold<2>& manifold);

}  // namespace abut
