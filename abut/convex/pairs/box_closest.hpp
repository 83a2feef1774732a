#pragma once

// The closest features of two boxes, in the frame of A. For .cpp files.

#include <abut/convex/pairs/box_frame.hpp>

namespace abut::detail {

struct BoxClosest {
    double distance = 0;
    Triple normal{};  ///< from A to B, of length 1
    Triple on_a{};
    CoreFeature part_a, part_b;
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

// The closest points of two disjoint boxes in closed form: a corner of one box and the other box, or an edge of each.
// The plane between the points proves the result.

/// The closest points of A and of a corner of B, or of the corner that it leads on to. Returns false if nothing is
/// proven: another corner, or none, is closest. Then `part_a` is the feature of A nearest to the last one.
bool nearest_from_corner(const BoxFrame& frame, std::uint32_t corner_of_b, BoxClosest& closest);

/// The closest points of the two edges of an edge axis, with the separation or overlap along it in `closest.distance`.
/// Returns false if the edges don't cross within their ends, or are parallel.
bool closest_on_edges(const BoxFrame& frame, std::size_t number, BoxClosest& closest);

/// Converts a result in the frame of a box to the world; `by_b` if the box is B.
inline void set_world_distance(const PlacedBox& box, const BoxClosest& closest, bool by_b, CoresDistance& found) {
    using namespace lanes;
    const Double2 distance = double2(closest.distance);
    const Double3 n = in_lanes(closest.normal), p = in_lanes(closest.on_a);
    found.distance = distance;
    found.normal = box.axes.vector(n) * double2(by_b ? -1 : 1);
    found.on_a = box.center + box.axes.vector(by_b ? p + n * distance : p);
    found.on_b = found.on_a + found.normal * distance;
    found.part_a = by_b ? closest.part_b : closest.part_a;
    found.part_b = by_b ? closest.part_a : closest.part_b;
}

}  // namespace abut::detail
