#pragma once

// The place on a box nearest to a point, seen from the box: so little that it is done in place. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/lanes-inl.h>

#include <cstdint>
#include <limits>

namespace abut {

/// A corner, edge or face of a box, by its bits: the axes along which it is at one end, and those of which it is the
/// low one.
struct BoxPlace {
    double distance;  ///< of the point; below zero inside
    DVec<3> normal;   ///< of length 1, towards the point; inside, the nearest way out
    std::uint32_t fixed, low;
};

inline void nearest_on_box(const DVec<3>& half, const DVec<3>& point, BoxPlace& place) {
    using namespace lanes;
    const Both reach{half.x, half.y}, reach_z{half.z, half.z}, at{point.x, point.y}, at_z{point.z, point.z}, none{0, 0};
    const Both inside = lesser(greater(at, -reach), reach), inside_z = lesser(greater(at_z, -reach_z), reach_z);
    const Both between = at - inside, between_z = at_z - inside_z, squares = between * between;
    const double square = squares[0] + squares[1] + between_z[0] * between_z[0];
    if (square > std::numeric_limits<double>::min()) {
        place.distance = std::sqrt(square);
        // The quotient beside the root, not after it.
        const double one = place.distance * (1 / square);
        place.normal = {between[0] * one, between[1] * one, between_z[0] * one};
        place.fixed = bits(between != none) | (bits(between_z != none) & 1u) << 2;
        place.low = bits(between < none) | (bits(between_z < none) & 1u) << 2;
        return;
    }
    int nearest = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(point[i]) - half[i] > std::abs(point[nearest]) - half[nearest]) nearest = i;
    const double sign = point[nearest] < 0 ? -1 : 1;
    place.distance = std::abs(point[nearest]) - half[nearest];
    place.normal = axis<3>(nearest, sign);
    place.fixed = 1u << nearest;
    place.low = sign < 0 ? place.fixed : 0;
}

}  // namespace abut
