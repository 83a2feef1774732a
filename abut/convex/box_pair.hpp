#pragma once

// A box against a box, both turned and moved and no more: all that is asked of them is answered from their axes.

#include <abut/convex/box_axes.hpp>
#include <abut/convex/box_meeting.hpp>
#include <abut/convex/manifold.hpp>

namespace abut {

/// Whether these answers are for a box: as it is, or scaled alike along all axes, and not all but flat. Those that are
/// left to the searches that take any pair.
inline bool has_volume(const Vec3& half) {
    const float most = std::max(std::max(half.x, half.y), half.z), least = std::min(std::min(half.x, half.y), half.z);
    return least > 1e-4f * most;
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

/// The same as the next, of boxes that are seen already, with nothing of the cache looked at; `distance` lacks the
/// corners, which the meeting has. Unknown where only a search can tell.
BoxContact contact_in_frame(const BoxFrame& frame, const BoxFaceGap& face, const BoxPlacement& a, const BoxPlacement& b,
                            double reach, double margin, Cache* cache, BoxMeeting& meeting, SignedDistance<3>& distance,
                            Manifold<3>& points);

/// False where they are farther apart than `reach`. The points are those of `manifold`, under names of their own.
bool contact_of_boxes(const Convex<3>& a, const Convex<3>& b, double reach, double margin,
                      const SearchOptions<3>& options, SignedDistance<3>& distance, Manifold<3>& points);

}  // namespace abut
