#pragma once

// The place on a box nearest to a point, seen from the box: so little that it is done in place. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/lanes-inl.h>

#include <cstdint>
#include <limits>

namespace abut {

/// A corner, edge or face of a box, by its bits: the axes along which it is at one end, and those of which it is the
/// low one. Numbers are in both lanes.
struct BoxPlace {
    lanes::Spatial way;      ///< to the point; inside, one of length 1 along the nearest way out
    lanes::Both distance;    ///< of the point; below zero inside
    lanes::Both per_length;  ///< what makes a unit vector of the way
    std::uint32_t fixed, low;
};

/// Of a point outside; false where it isn't, or not finite.
inline bool nearest_from_outside(const lanes::Spatial& half, const lanes::Spatial& point, BoxPlace& place) {
    using namespace lanes;
    const Spatial inside{lesser(greater(point.xy, -half.xy), half.xy), lesser(greater(point.z, -half.z), half.z)};
    place.way = point - inside;
    const Both square = dot(place.way, place.way), none{0, 0};
    place.distance = root(square);
    // The quotient beside the root, not after it.
    place.per_length = place.distance * (1 / square);
    place.fixed = bits(place.way.xy != none) | (bits(place.way.z != none) & 1u) << 2;
    place.low = signs(place.way.xy) | (signs(place.way.z) & 1u) << 2;
    return square[0] > std::numeric_limits<double>::min() && square[0] <= std::numeric_limits<double>::max();
}

/// Of a point inside.
inline void nearest_from_inside(const DVec<3>& half, const DVec<3>& point, BoxPlace& place) {
    int nearest = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(point[i]) - half[i] > std::abs(point[nearest]) - half[nearest]) nearest = i;
    const double sign = point[nearest] < 0 ? -1 : 1;
    place.way = lanes::spatial(axis<3>(nearest, sign));
    place.distance = lanes::both(std::abs(point[nearest]) - half[nearest]);
    place.per_length = lanes::both(1);
    place.fixed = 1u << nearest;
    place.low = sign < 0 ? place.fixed : 0;
}

}  // namespace abut
