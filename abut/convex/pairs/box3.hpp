#pragma once

// Queries of two boxes, by their separating axes. A box may be flat.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/box_closest.hpp>

namespace abut::detail {

/// The core of a box.
inline PlacedBox placed_box(const Convex<3>& box) {
    return {box.place, box.scale, box.own[0]};
}

/// `unknown` if a number isn't finite, or if only the general algorithms can decide.
enum class BoxAnswer : std::uint8_t { no, yes, unknown };

/// Whether the boxes are at most `reach` apart, which is not below zero. The cache may be null.
BoxAnswer boxes_within(const PlacedBox& a, const PlacedBox& b, double reach, Cache* cache);

/// The closest features of two boxes, and the distance without its corners, which set_corners() adds.
struct BoxesDistance {
    BoxClosest closest;
    SignedDistance<3> distance;
};

/// The answer is `yes` or `unknown`.
BoxAnswer distance_of_boxes(const PlacedBox& a, const PlacedBox& b, Cache* cache, BoxesDistance& result);

/// The answer is `no` if the distance is above `reach`. The points are those of `manifold`, with feature names of their
/// own.
BoxAnswer contact_of_boxes(const PlacedBox& a, const PlacedBox& b, double reach, double margin, Cache* cache,
                           BoxesDistance& result, Manifold<3>& points);

/// Adds the separating axes to the trace.
void record_axes(const PlacedBox& a, const PlacedBox& b, Trace<3>& trace);

}  // namespace abut::detail
