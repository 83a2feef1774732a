#pragma once

// Pairs of plain shapes in the plane: circles, capsules, segments, triangles, boxes and polygons of few edges, each
// against each. One closed form serves a pair of shapes without rows, another any pair. They return what
// `signed_distance` and `manifold` return, or `unknown`. For .cpp files.

#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/core_contact2.hpp>

namespace abut::detail {

// A polygon may get rows, and its corners new numbers. The corners of the answers have the numbers of the shapes.

/// Whether the distance of two shapes is at most `reach`.
PairAnswer pair2_within(PlacedPolygon& a, PlacedPolygon& b, double reach, Cache* cache);

/// The closest features of the cores, unless they are unknown.
PairAnswer pair2_closest(PlacedPolygon& a, PlacedPolygon& b, Cache* cache, ClosestFeatures2& closest);

/// The contact if the distance is at most `reach`; its points have gaps of at most `margin`.
PairAnswer pair2_contact(PlacedPolygon& a, PlacedPolygon& b, double reach, double margin, Cache* cache,
                         ClosestFeatures2& closest, ContactLanes& points);

inline void write(const ClosestFeatures2& closest, const PlacedPolygon& a, const PlacedPolygon& b,
                  SignedDistance<2>& result) {
    const Double2 out = closest.from_a();
    result.distance = closest.gap - a.radius - b.radius;
    result.normal = vector_of(out);
    result.on_a = vector_of(closest.on_a() + out * lanes::double2(a.radius));
    for (std::size_t i = 0; i < 2; ++i) {
        result.corners.a[i] = closest.corners[0][i];
        result.corners.b[i] = closest.corners[1][i];
    }
    result.corners.count = 2;
}
inline void write(const ContactLanes& points, Manifold<2>& result) {
    result.count = 0;
    for (std::size_t i = 0; i < 2; ++i)
        if ((points.mask >> i & 1u) != 0)
            result.points[result.count++] = {{points.x[i], points.y[i]}, points.depth[i], points.features[i]};
}

}  // namespace abut::detail
