#pragma once

// Points, segments and boxes in the world, each with a ball around it, and the answer for a pair of them. Made of plain
// shapes or of views; numbers are in lanes, and scalars in both lanes. For .cpp files.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/math/simd/rotation-inl.h>

namespace abut::detail {

struct PlacedBall {
    lanes::Double3 center;
    lanes::Double2 radius;
};

struct PlacedSegment {
    lanes::Double3 from, to;
    lanes::Double2 radius;
};

struct PlacedBox {
    lanes::Turned axes;  ///< the columns; of length 1
    lanes::Double3 center, half;
    lanes::Double2 radius;

    [[gnu::always_inline]] PlacedBox(const Vec3& center_of_box, const Vec3& half_of_box, const glm::quat& rotation)
        : axes(lanes::turned(rotation)),
          center(lanes::loaded(center_of_box)),
          half(lanes::loaded(half_of_box)),
          radius(lanes::double2(0)) {}
    PlacedBox(const Affine<3>& place, double scale, const Vec3& half_of_box, double radius_around)
        : axes(lanes::scaled(place.column, 1 / scale)),
          center(lanes::double3(place.offset)),
          half(lanes::loaded(half_of_box) * lanes::double2(scale)),
          radius(lanes::double2(radius_around)) {}
};

/// A vertex, edge or face of a box by its bits: the axes at whose low end it is, and the axes along which it extends. A
/// segment is a box of one axis, a point a box of none. The bits are the numbers of corners.
struct CoreFeature {
    std::uint32_t low = 0, free = 0;
};

/// The signed distance of two cores with their balls, and the features at the closest points.
struct CoresDistance {
    lanes::Double2 distance;
    lanes::Double3 normal, on_a, on_b;  ///< as in a SignedDistance
    CoreFeature part_a, part_b;
};

/// Sets the ends or edges of two segments at their parameters from 0 to 1, by masks: compilers turn conditions into
/// branches, which can't be predicted.
inline void set_segment_features(lanes::Double2 parts, CoresDistance& found) {
    const std::uint32_t started = lanes::bits(parts > lanes::Double2{0, 0});
    const std::uint32_t ended = lanes::bits(parts >= lanes::Double2{1, 1}), between = started ^ ended;
    found.part_a = {ended & 1u, between & 1u};
    found.part_b = {ended >> 1, between >> 1};
}

/// Turns the answer for a pair (A, B) into that for (B, A).
inline void flip(CoresDistance& found) {
    found.normal = found.normal * lanes::double2(-1);
    std::swap(found.on_a, found.on_b);
    std::swap(found.part_a, found.part_b);
}

/// Adds the balls around A and B to the answer for the cores.
inline void add_balls(lanes::Double2 radius_a, lanes::Double2 radius_b, CoresDistance& found) {
    found.distance = found.distance - radius_a - radius_b;
    found.on_a = found.on_a + found.normal * radius_a;
    found.on_b = found.on_b - found.normal * radius_b;
}

/// The corners that span a feature, by number; three of a face. If there are fewer than three, the last is repeated.
struct FeatureCorners {
    std::array<std::uint32_t, 3> numbers;
    std::size_t count;

    explicit FeatureCorners(const CoreFeature& part) {
        static constexpr std::uint32_t bits[8][3] = {{0, 0, 0}, {0, 1, 1}, {0, 2, 2}, {0, 1, 2},
                                                     {0, 4, 4}, {0, 1, 4}, {0, 2, 4}, {0, 1, 2}};
        for (std::size_t i = 0; i < 3; ++i) numbers[i] = part.low | bits[part.free][i];
        count = part.free == 0 ? 1 : (part.free & (part.free - 1)) == 0 ? 2 : 3;
    }
};

inline void set_corners(const CoreFeature& part_a, const CoreFeature& part_b, ClosestCorners<3>& corners) {
    const FeatureCorners of_a(part_a), of_b(part_b);
    corners.count = std::max(of_a.count, of_b.count);
    for (std::size_t i = 0; i < 3; ++i) {
        corners.a[i] = of_a.numbers[i];
        corners.b[i] = of_b.numbers[i];
    }
}

inline void set_distance(const CoresDistance& found, SignedDistance<3>& result) {
    result.distance = found.distance[0];
    put(found.normal, &result.normal.x);
    put(found.on_a, &result.on_a.x);
    set_corners(found.part_a, found.part_b, result.corners);
}

}  // namespace abut::detail
