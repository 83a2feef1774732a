#pragma once

// A rotation of the plane at length 1, in double. For .cpp files.

#include <abut/math/linear.hpp>

namespace abut {

/// Of no length: no turn. A turn that is a unit vector but for its rounding to floats needs no root: what is left of
/// the series after so many terms is below a double's last digit.
inline DVec<2> unit(const Turn& turn) {
    const DVec<2> u(turn.cos, turn.sin);
    const double squared = dot(u, u), e = squared - 1;  // no square of a float overflows a double, or vanishes
    if (std::abs(e) < 1e-5) return u * (1 - e * (0.5 - e * (0.375 - e * 0.3125)));
    return squared == 0 ? DVec<2>(1, 0) : u / std::sqrt(squared);
}

/// affine(pose), where a call would cost more than it does.
inline void set_affine(Affine<2>& map, const Pose2& pose) {
    const DVec<2> u = unit(pose.rotation);
    map.column[0] = u;
    map.column[1] = DVec<2>(0 - u.y, u.x);  // no zero below zero, as in a product of maps
    map.offset = DVec<2>(pose.position);
}
inline void set_affine(Affine<3>& map, const Pose3& pose) {
    map = affine(pose);
}

}  // namespace abut
