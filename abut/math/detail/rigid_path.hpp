#pragma once

// Rigid motions in double, for time of impact queries. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/affine.hpp>
#include <abut/math/detail/sin_cos.hpp>
#include <abut/math/motion.hpp>

#include <algorithm>

namespace abut::detail {

/// Angular velocity in radians per unit of time (the whole motion); in 3D along the axis.
template <int D>
using AngularVelocity = std::conditional_t<D == 2, double, DVec<3>>;

/// The velocity of a vector that rotates: angular_velocity x v.
inline DVec<2> rotational_velocity(double angular_velocity, const DVec<2>& v) {
    return {-angular_velocity * v.y, angular_velocity * v.x};
}
inline DVec<3> rotational_velocity(const DVec<3>& angular_velocity, const DVec<3>& v) {
    return cross(angular_velocity, v);
}

inline double angular_speed(double angular_velocity) {
    return std::abs(angular_velocity);
}
inline double angular_speed(const DVec<3>& angular_velocity) {
    return length(angular_velocity);
}

/// A vector that rotates at constant angular velocity, as a function of the angle.
struct RotatingVector2 {
    DVec<2> first;

    DVec<2> at(const SinCos& s) const { return {first.x * s.cos - first.y * s.sin, first.y * s.cos + first.x * s.sin}; }
};
/// In 3D: the component along the axis, and the components across it at angle 0 and a quarter turn later.
struct RotatingVector3 {
    DVec<3> along, even, odd;

    DVec<3> at(const SinCos& s) const { return along + even * s.cos + odd * s.sin; }
};
template <int D>
using RotatingVector = std::conditional_t<D == 2, RotatingVector2, RotatingVector3>;

/// The rotation axis: the pivot in 2D, a unit vector in 3D. The angle grows by `rate` over time 0 to 1.
struct RotationAxis2 {
    explicit RotationAxis2(double angular_velocity) : rate(angular_velocity) {}
    RotatingVector2 of(const DVec<2>& v) const { return {v}; }

    double rate;
};
struct RotationAxis3 {
    explicit RotationAxis3(const DVec<3>& angular_velocity)
        : rate(length(angular_velocity)), axis(rate > 0 ? angular_velocity / rate : DVec<3>(0.0)) {}
    RotatingVector3 of(const DVec<3>& v) const {
        const DVec<3> along = axis * dot(axis, v);
        return {along, v - along, cross(axis, v)};
    }

    double rate;
    DVec<3> axis;
};
template <int D>
using RotationAxis = std::conditional_t<D == 2, RotationAxis2, RotationAxis3>;

/// A rigid motion over time 0 to 1.
template <int D>
struct RigidPath {
    Affine<D> start;  ///< the initial pose; its offset is the center of rotation
    DVec<D> move{0.0};
    AngularVelocity<D> angular_velocity{};

    DVec<D> pivot(double time) const { return start.offset + move * time; }
    /// The velocity of a point of the body that is at `place` at that time.
    DVec<D> velocity(double time, const DVec<D>& place) const {
        return move + rotational_velocity(angular_velocity, place - pivot(time));
    }
};

/// Upper bounds of a point's relative speed |x'| and acceleration |x''| over time 0 to 1.
struct RelativeMotionBounds {
    double speed, acceleration;
};

/// The largest distance of a body from its pivot, the origin, by its box; infinite without bounds.
template <int D>
double reach_of(const Aabb<D>& box) {
    DVec<D> farthest;
    for (int i = 0; i < D; ++i)
        farthest[i] = std::max(std::abs(static_cast<double>(box.min[i])), std::abs(static_cast<double>(box.max[i])));
    return length(farthest);
}

/// Bounds for the points of a body within `reach` of its pivot, in the rotating frame of another path. With p from the
/// frame's pivot to the body's, and y from that to the point, x = R^T (p + y), so that
///
///     |x'|  <= |p'| + w |p| + (v + w) |y|,
///     |x''| <= 2 w |p'| + w^2 |p| + (v + w)^2 |y|,    w, v the angular speeds of the frame and of the path.
template <int D>
RelativeMotionBounds relative_motion_bounds(const RigidPath<D>& path, const RigidPath<D>& frame, double reach) {
    const double w = angular_speed(frame.angular_velocity), both_rates = w + angular_speed(path.angular_velocity);
    // The distance to a point on a line segment is largest at an end.
    const double p = std::max(length(path.pivot(0) - frame.pivot(0)), length(path.pivot(1) - frame.pivot(1)));
    const double speed = length(path.move - frame.move);
    return {speed + w * p + both_rates * reach, 2 * w * speed + w * w * p + both_rates * both_rates * reach};
}

RigidPath<2> rigid_path(const Motion2& motion);
RigidPath<3> rigid_path(const Motion3& motion);

/// The motion by the shortest rotation, without rounding the angle to float.
RigidPath<2> rigid_path(const Pose2& from, const Pose2& to);
RigidPath<3> rigid_path(const Pose3& from, const Pose3& to);

/// The transform of the body at a time.
template <int D>
Affine<D> place_at(const RigidPath<D>& path, double time);

}  // namespace abut::detail
