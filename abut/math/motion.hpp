#pragma once

// A rigid motion: an initial pose, a translation, and a rotation.

#include <abut/math/pose.hpp>

namespace abut {

/// A rotation of a motion. In 2D an angle in radians, counter-clockwise; in 3D a rotation vector in world space (axis
/// times angle). Full turns count: 2 pi is one revolution.
template <int D>
using Angle = std::conditional_t<D == 2, float, Vec3>;

/// The position moves from `from.position` by `move` at constant velocity. Meanwhile the shape rotates by `turn` at
/// constant angular velocity about that position, the origin of its local frame.
///
/// Two poses don't say whether a wheel stood still or made one revolution; a motion does.
template <int D>
struct Motion {
    Pose<D> from{};
    Vec<D> move{};
    Angle<D> turn{};

    /// The motion between two poses by the shortest rotation, at most half a turn. Of two equally short ones the choice
    /// is deterministic.
    static Motion between(const Pose<D>& from, const Pose<D>& to);

    friend bool operator==(const Motion&, const Motion&) = default;
};
using Motion2 = Motion<2>;
using Motion3 = Motion<3>;

/// The pose at a fraction of the motion; the same bits on every machine.
Pose2 pose_at(const Motion2& motion, float fraction);
Pose3 pose_at(const Motion3& motion, float fraction);

extern template struct Motion<2>;
extern template struct Motion<3>;

}  // namespace abut
