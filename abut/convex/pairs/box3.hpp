#pragma once

// Queries of two boxes of some volume, by their separating axes.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/box_closest.hpp>

namespace abut::detail {

/// Whether a box isn't nearly flat. Flat boxes take the general algorithms.
inline bool has_volume(const Vec3& half) {
    const float longest = std::max(std::max(half.x, half.y), half.z),
                shortest = std::min(std::min(half.x, half.y), half.z);
    return shortest > 1e-4f * longest;
}
inline bool is_plain_box_of_volume(const Convex<3>& box) {
    return is_plain_box(box) && box.radius == 0 && has_volume(box.own[0]);
}
inline bool are_plain_boxes(const Convex<3>& a, const Convex<3>& b) {
    return is_plain_box_of_volume(a) && is_plain_box_of_volume(b);
}
inline PlacedBox placed_box(const Convex<3>& box) {
    return {box.place, box.scale, box.own[0]};
}

/// `unknown` if a number isn't finite, or if only the general algorithms can decide.
enum class BoxAnswer : std::uint8_t { no, yes, unknown };

/// The cache may be null.
BoxAnswer boxes_overlap(const PlacedBox& a, const PlacedBox& b, Cache* cache);

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

}  // namespace abut::detail
