#pragma once

// Queries of two boxes, by their separating axes. A box may be flat. For .cpp files.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/box_axes.hpp>
#include <abut/convex/pairs/pair_answer.hpp>

namespace abut::detail {

/// Warm start: whether the cached axis still separates the boxes by more than `reach`. An unset axis separates nothing.
bool still_separated(const PlacedBox& a, const PlacedBox& b, double reach, const Cache& cache);

// The cache may be null.

/// For boxes of which the cheap tests have separated nothing.
PairAnswer boxes_overlap(const PlacedBox& a, const PlacedBox& b, const BoxFaceGaps& gaps, Cache* cache);

[[gnu::always_inline]] inline PairAnswer boxes_overlap(const PlacedBox& a, const PlacedBox& b, Cache* cache) {
    const double reach = a.radius[0] + b.radius[0];
    if (cache != nullptr && still_separated(a, b, reach, *cache)) return PairAnswer::no;
    const BoxFaceGaps gaps(a, b);
    if (!gaps.finite()) return PairAnswer::unknown;
    if (cache == nullptr && gaps.any_wider_than(reach)) return PairAnswer::no;
    return boxes_overlap(a, b, gaps, cache);
}

/// Returns false if it is unknown. Where the boxes are apart, the cache receives the answer.
bool distance_of_boxes(const PlacedBox& a, const PlacedBox& b, Cache* cache, CoresDistance& found);

/// The answer is `no` if the distance is above `reach`. The boxes have no balls. The points are those of `manifold`,
/// with feature names of their own.
PairAnswer contact_of_boxes(const PlacedBox& a, const PlacedBox& b, double reach, double margin, Cache* cache,
                            CoresDistance& found, Manifold<3>& points);

/// Adds the separating axes to the trace.
void record_axes(const PlacedBox& a, const PlacedBox& b, Trace<3>& trace);

}  // namespace abut::detail
