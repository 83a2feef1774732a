#pragma once

// Motions in double, as the engines follow them. For .cpp files.

#include <abut/math/linear.hpp>
#include <abut/math/motion.hpp>
#include <abut/math/sin_cos.hpp>

#include <algorithm>

namespace abut {

/// How fast a thing turns, in radians for the whole of its motion; in 3D along the axis.
template <int D>
using Spin = std::conditional_t<D == 2, double, DVec<3>>;

/// How fast a vector moves that turns with it: spin x v.
inline DVec<2> turned_by(double spin, const DVec<2>& v) {
    return {-spin * v.y, spin * v.x};
}
inline DVec<3> turned_by(const DVec<3>& spin, const DVec<3>& v) {
    return cross(spin, v);
}

inline double rate_of(double spin) {
    return std::abs(spin);
}
inline double rate_of(const DVec<3>& spin) {
    return length(spin);
}

/// A vector that turns evenly, told by how far it has turned.
struct TurningVector2 {
    DVec<2> first;

    DVec<2> at(const SinCos& s) const { return {first.x * s.cos - first.y * s.sin, first.y * s.cos + first.x * s.sin}; }
};
/// In space: along the axis, and across it at the angle 0 and a quarter of a turn later.
struct TurningVector3 {
    DVec<3> along, even, odd;

    DVec<3> at(const SinCos& s) const { return along + even * s.cos + odd * s.sin; }
};
template <int D>
using TurningVector = std::conditional_t<D == 2, TurningVector2, TurningVector3>;

/// What vectors turn about: in the plane the pivot, in space an axis of length 1; the angle grows by `rate` in the time
/// from 0 to 1.
struct TurningAxis2 {
    explicit TurningAxis2(double spin) : rate(spin) {}
    TurningVector2 of(const DVec<2>& v) const { return {v}; }

    double rate;
};
struct TurningAxis3 {
    explicit TurningAxis3(const DVec<3>& spin) : rate(length(spin)), axis(rate > 0 ? spin / rate : DVec<3>(0.0)) {}
    TurningVector3 of(const DVec<3>& v) const {
        const DVec<3> along = axis * dot(axis, v);
        return {along, v - along, cross(axis, v)};
    }

    double rate;
    DVec<3> axis;
};
template <int D>
using TurningAxis = std::conditional_t<D == 2, TurningAxis2, TurningAxis3>;

/// A motion in the time from 0 to 1.
template <int D>
struct RigidPath {
    Affine<D> start;  ///< the pose at first; its offset is what the thing turns about
    DVec<D> move{0.0};
    Spin<D> spin{};

    DVec<D> pivot(double time) const { return start.offset + move * time; }
    /// Of a point of the thing that is at `place` at that time.
    DVec<D> velocity(double time, const DVec<D>& place) const { return move + turned_by(spin, place - pivot(time)); }
};

/// The most that a point moves and bends, |x'| and |x''|, in the time from 0 to 1.
struct SeenMotion {
    double speed, bend;
};

/// Of the points of a thing on a path that are at most `reach` from its pivot, as the frame of another path sees them.
/// There, with p from the frame's pivot to the thing's and y from that to the point, x = R^T (p + y), so that
///
///     |x'|  <= |p'| + w |p| + (v + w) |y|,
///     |x''| <= 2 w |p'| + w^2 |p| + (v + w)^2 |y|,    w, v the rates of the frame and of the path.
template <int D>
SeenMotion seen_motion(const RigidPath<D>& path, const RigidPath<D>& frame, double reach) {
    const double w = rate_of(frame.spin), both = w + rate_of(path.spin);
    // A straight way is farthest from a point at one of its ends.
    const double p = std::max(length(path.pivot(0) - frame.pivot(0)), length(path.pivot(1) - frame.pivot(1)));
    const double speed = length(path.move - frame.move);
    return {speed + w * p + both * reach, 2 * w * speed + w * w * p + both * both * reach};
}

RigidPath<2> rigid_path(const Motion2& motion);
RigidPath<3> rigid_path(const Motion3& motion);

/// Turning the short way, without the rounding of its angle to floats.
RigidPath<2> rigid_path(const Pose2& from, const Pose2& to);
RigidPath<3> rigid_path(const Pose3& from, const Pose3& to);

/// Where the path has come to.
template <int D>
Affine<D> place_at(const RigidPath<D>& path, double time);

}  // namespace abut
