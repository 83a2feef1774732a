#pragma once

// Where two boxes meet: what the searches of this folder find along the axes of A. For .cpp files.

#include <abut/convex/box_frame.hpp>
#include <abut/convex/signed_distance.hpp>

namespace abut {

/// A corner, edge or face of a box by its bits: the axes along which it is at the low end, and those along which it
/// extends.
struct BoxPart {
    std::uint32_t low = 0, free = 0;
};

struct BoxMeeting {
    double distance = 0;
    Triple normal{};  ///< from A to B, of length 1
    Triple on_a{};
    BoxPart part_a, part_b;
};

/// Turns what B found of A into what A sees; `frame` is A's.
inline void turn_round(const BoxFrame& frame, BoxMeeting& meeting) {
    const Triple n{meeting.normal[0], meeting.normal[1], meeting.normal[2]};
    const double d = meeting.distance;
    const Triple p{meeting.on_a[0] + n[0] * d, meeting.on_a[1] + n[1] * d, meeting.on_a[2] + n[2] * d};
    const auto& axes = frame.axis_b;
    for (std::size_t i = 0; i < 3; ++i) {
        meeting.normal[i] = -(axes[0][i] * n[0] + axes[1][i] * n[1] + axes[2][i] * n[2]);
        meeting.on_a[i] = frame.middle[i] + (axes[0][i] * p[0] + axes[1][i] * p[1] + axes[2][i] * p[2]);
    }
    std::swap(meeting.part_a, meeting.part_b);
}

/// The corners that span a part, by number; of a face three. Where they are fewer than three the last is there again.
struct BoxPartCorners {
    std::array<std::uint32_t, 3> numbers;
    std::size_t count;

    explicit BoxPartCorners(const BoxPart& part) {
        static constexpr std::uint32_t bits[8][3] = {{0, 0, 0}, {0, 1, 1}, {0, 2, 2}, {0, 1, 2},
                                                     {0, 4, 4}, {0, 1, 4}, {0, 2, 4}, {0, 1, 2}};
        for (std::size_t i = 0; i < 3; ++i) numbers[i] = part.low | bits[part.free][i];
        count = part.free == 0 ? 1 : (part.free & (part.free - 1)) == 0 ? 2 : 3;
    }
};

/// What was found along the axes of A; or, `by_b`, along those of B, with B as the first of the two. Without the
/// corners. Number by number: a vector that is copied as soon as its numbers are known waits for all of them to reach
/// the memory.
inline void in_world(const BoxPlacement& box, const BoxMeeting& meeting, bool by_b, SignedDistance<3>& result) {
    const double one = box.one, one_normal = by_b ? -one : one, beyond = by_b ? meeting.distance : 0;
    const Triple &n = meeting.normal, &p = meeting.on_a;
    const Triple on_a{p[0] + n[0] * beyond, p[1] + n[1] * beyond, p[2] + n[2] * beyond};
    const Affine<3>& place = box.place;
    result.distance = meeting.distance;
    for (int i = 0; i < 3; ++i) {
        const double x = place.column[0][i], y = place.column[1][i], z = place.column[2][i];
        result.normal[i] = (x * n[0] + y * n[1] + z * n[2]) * one_normal;
        result.on_a[i] = place.offset[i] + (x * on_a[0] + y * on_a[1] + z * on_a[2]) * one;
    }
}

inline void set_corners(const BoxMeeting& meeting, bool by_b, MeetingCorners<3>& corners) {
    const BoxPartCorners first(meeting.part_a), second(meeting.part_b);
    corners.count = std::max(first.count, second.count);
    for (std::size_t i = 0; i < 3; ++i) {
        corners.a[i] = by_b ? second.numbers[i] : first.numbers[i];
        corners.b[i] = by_b ? first.numbers[i] : second.numbers[i];
    }
}

}  // namespace abut
