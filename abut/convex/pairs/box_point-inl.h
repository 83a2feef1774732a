#pragma once

// The closest point on a box, in the frame of the box. Inline, because it is short. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/simd/double2-inl.h>

#include <cstdint>
#include <limits>

namespace abut::detail {

/// The vertex, edge or face of a box by its bits: the axes at one end, and among those the axes at the low end. Numbers
/// are in both lanes.
struct BoxClosestPoint {
    lanes::Double3 offset;      ///< to the point; inside, of length 1 along the nearest outward normal
    lanes::Double2 distance;    ///< of the point; below zero inside
    lanes::Double2 per_length;  ///< normalises the offset
    std::uint32_t fixed, low;
};

/// For a point outside. Returns false if it isn't outside, or not finite.
inline bool nearest_from_outside(const lanes::Double3& half, const lanes::Double3& point, BoxClosestPoint& place) {
    using namespace lanes;
    const Double3 inside{lesser(greater(point.xy, -half.xy), half.xy), lesser(greater(point.z, -half.z), half.z)};
    place.offset = point - inside;
    const Double2 square = dot(place.offset, place.offset), none{0, 0};
    place.distance = root(square);
    // The division runs in parallel with the root.
    place.per_length = place.distance * (1 / square);
    place.fixed = bits(place.offset.xy != none) | (bits(place.offset.z != none) & 1u) << 2;
    place.low = signs(place.offset.xy) | (signs(place.offset.z) & 1u) << 2;
    return square[0] > std::numeric_limits<double>::min() && square[0] <= std::numeric_limits<double>::max();
}

/// For a point inside.
inline void nearest_from_inside(const DVec<3>& half, const DVec<3>& point, BoxClosestPoint& place) {
    int nearest = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(point[i]) - half[i] > std::abs(point[nearest]) - half[nearest]) nearest = i;
    const double sign = point[nearest] < 0 ? -1 : 1;
    place.offset = lanes::double3(axis<3>(nearest, sign));
    place.distance = lanes::double2(std::abs(point[nearest]) - half[nearest]);
    place.per_length = lanes::double2(1);
    place.fixed = 1u << nearest;
    place.low = sign < 0 ? place.fixed : 0;
}

}  // namespace abut::detail
