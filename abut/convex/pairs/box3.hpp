#pragma once

// Queries of two boxes of some volume, by their separating axes.

#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/box_axes.hpp>
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

bool boxes_overlap(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options);

SignedDistance<3> distance_of_boxes(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options);

enum class BoxContact : std::uint8_t { none, some, unknown };

/// `contact_of_boxes` for boxes in A's frame, without reading the cache; `distance` lacks the corners, which `closest`
/// has. Returns `unknown` if only the general algorithms can decide.
BoxContact contact_in_frame(const BoxFrame& frame, const BoxFaceGap& face, const BoxPlacement& a, const BoxPlacement& b,
                            double reach, double margin, Cache* cache, BoxClosest& closest, SignedDistance<3>& distance,
                            Manifold<3>& points);

/// Returns false if the distance is above `reach`. The points are those of `manifold`, with feature names of their own.
bool contact_of_boxes(const Convex<3>& a, const Convex<3>& b, double reach, double margin,
                      const SearchOptions<3>& options, SignedDistance<3>& distance, Manifold<3>& points);

}  // namespace abut::detail
