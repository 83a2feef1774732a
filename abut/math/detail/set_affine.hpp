#pragma once

// Poses to affine maps, written in place. For .cpp files.

#include <abut/math/affine.hpp>

namespace abut::detail {

inline DVec<2> unit(const Turn& turn) {
    return unit(DVec<2>(turn.cos, turn.sin));
}

/// affine(pose), inline and without a copy.
inline void set_affine(Affine<2>& map, const Pose2& pose) {
    const DVec<2> u = unit(pose.rotation);
    map.column[0] = u;
    map.column[1] = DVec<2>(0 - u.y, u.x);  // 0 - y avoids -0, as in a product of maps
    map.offset = DVec<2>(pose.position);
}
/// The matrix of q / |q|; in double the square of a float can't overflow, and it vanishes only for 0.
inline void set_affine(Affine<3>& map, const Pose3& pose) {
    const double w = static_cast<double>(pose.rotation.w), x = static_cast<double>(pose.rotation.x),
                 y = static_cast<double>(pose.rotation.y), z = static_cast<double>(pose.rotation.z);
    const double norm_squared = (x * x + z * z) + (y * y + w * w);
    const double s = norm_squared == 0 ? 0 : 2 / norm_squared;
    const double sx = x * s, sy = y * s, sz = z * s;
    const double xx = x * sx, yy = y * sy, zz = z * sz, xy = x * sy, xz = x * sz, yz = y * sz;
    const double wx = w * sx, wy = w * sy, wz = w * sz;
    map.column[0] = DVec<3>(1 - (yy + zz), xy + wz, xz - wy);
    map.column[1] = DVec<3>(xy - wz, 1 - (xx + zz), yz + wx);
    map.column[2] = DVec<3>(xz + wy, yz - wx, 1 - (xx + yy));
    map.offset = DVec<3>(pose.position);
}

/// affine(pose).point(point), not inlined, to keep hot code small.
template <int D>
[[gnu::noinline]] DVec<D> placed(const DVec<D>& point, const Pose<D>& pose) {
    Affine<D> place;
    set_affine(place, pose);
    return place.point(point);
}

}  // namespace abut::detail
