#pragma once

// Queries of two boxes, by their separating axes. A box may be flat.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/pair_answer.hpp>
#include <abut/convex/pairs/placed_cores.hpp>

namespace abut::detail {

// The cache may be null.

PairAnswer boxes_overlap(const PlacedBox& a, const PlacedBox& b, Cache* cache);

/// Returns false if it is unknown. Where the boxes are apart, the cache receives the answer.
bool distance_of_boxes(const PlacedBox& a, const PlacedBox& b, Cache* cache, CoresDistance& found);

/// The answer is `no` if the distance is above `reach`. The boxes have no balls. The points are those of `manifold`,
/// with feature names of their own.
PairAnswer contact_of_boxes(const PlacedBox& a, const PlacedBox& b, double reach, double margin, Cache* cache,
                            CoresDistance& found, Manifold<3>& points);

/// Adds the separating axes to the trace.
void record_axes(const PlacedBox& a, const PlacedBox& b, Trace<3>& trace);

}  // namespace abut::detail
