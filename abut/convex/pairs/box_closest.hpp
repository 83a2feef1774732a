#pragma once

// The closest features of two boxes, in the frame of A. For .cpp files.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/convex/pairs/box_frame.hpp>

namespace abut::detail {

/// A vertex, edge or face of a box by its bits: the axes at whose low end it is, and the axes along which it extends.
struct BoxFeature {
    std::uint32_t low = 0, free = 0;
};

struct BoxClosest {
    double distance = 0;
    Triple normal{};  ///< from A to B, of length 1
    Triple on_a{};
    BoxFeature part_a, part_b;
};

/// Turns the answer for the pair (B, A) in B's frame into that for (A, B) in A's frame; `frame` is A's.
inline void flip(const BoxFrame& frame, BoxClosest& closest) {
    const Triple n{closest.normal[0], closest.normal[1], closest.normal[2]};
    const double d = closest.distance;
    const Triple p{closest.on_a[0] + n[0] * d, closest.on_a[1] + n[1] * d, closest.on_a[2] + n[2] * d};
    const auto& axes = frame.axis_b;
    for (std::size_t i = 0; i < 3; ++i) {
        closest.normal[i] = -(axes[0][i] * n[0] + axes[1][i] * n[1] + axes[2][i] * n[2]);
        closest.on_a[i] = frame.middle[i] + (axes[0][i] * p[0] + axes[1][i] * p[1] + axes[2][i] * p[2]);
    }
    std::swap(closest.part_a, closest.part_b);
}

/// The corners that span a feature, by number; three of a face. If there are fewer than three, the last is repeated.
struct BoxFeatureCorners {
    std::array<std::uint32_t, 3> numbers;
    std::size_t count;

    explicit BoxFeatureCorners(const BoxFeature& part) {
        static constexpr std::uint32_t bits[8][3] = {{0, 0, 0}, {0, 1, 1}, {0, 2, 2}, {0, 1, 2},
                                                     {0, 4, 4}, {0, 1, 4}, {0, 2, 4}, {0, 1, 2}};
        for (std::size_t i = 0; i < 3; ++i) numbers[i] = part.low | bits[part.free][i];
        count = part.free == 0 ? 1 : (part.free & (part.free - 1)) == 0 ? 2 : 3;
    }
};

/// Converts a result in the frame of a box to the world, without the corners; `by_b` if the box is B.
inline void set_world_distance(const PlacedBox& box, const BoxClosest& closest, bool by_b, SignedDistance<3>& result) {
    using namespace lanes;
    const Double3 n = double3(closest.normal), p = double3(closest.on_a);
    const Double3 on_a = by_b ? p + n * double2(closest.distance) : p;
    result.distance = closest.distance;
    put(box.axes.vector(n) * double2(by_b ? -1 : 1), &result.normal.x);
    put(box.center + box.axes.vector(on_a), &result.on_a.x);
}

inline void set_corners(const BoxClosest& closest, ClosestCorners<3>& corners) {
    const BoxFeatureCorners of_a(closest.part_a), of_b(closest.part_b);
    corners.count = std::max(of_a.count, of_b.count);
    for (std::size_t i = 0; i < 3; ++i) {
        corners.a[i] = of_a.numbers[i];
        corners.b[i] = of_b.numbers[i];
    }
}

}  // namespace abut::detail
