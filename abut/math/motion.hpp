#pragma once

// A rigid motion in one step: where a thing is at first, how far it goes, and how far it turns on the way.

#include <abut/math/pose.hpp>

namespace abut {

/// How far a thing turns: an angle in radians in 2D, counter-clockwise; in 3D the axis in the world, as long as the
/// angle about it. Whole turns count: 2 pi is once around.
template <int D>
using Angle = std::conditional_t<D == 2, float, Vec3>;

/// The position goes straight, from `from.position` by `move`, and meanwhile the thing turns evenly by `turn` about
/// that position: the origin of its own frame.
///
/// Two poses alone don't tell whether a wheel stood still or went once around; a motion does.
template <int D>
struct Motion {
    Pose<D> from{};
    Vec<D> move{};
    Angle<D> turn{};

    /// From one pose to another, turning the short way: by at most half a turn. Of the two ways of half a turn it is
    /// always the same one for the same poses.
    static Motion between(const Pose<D>& from, const Pose<D>& to);

    friend bool operator==(const Motion&, const Motion&) = default;
};
using Motion2 = Motion<2>;
using Motion3 = Motion<3>;

/// Where the thing is after a fraction of its motion; the same bits on every machine.
Pose2 pose_at(const Motion2& motion, float fraction);
Pose3 pose_at(const Motion3& motion, float fraction);

extern template struct Motion<2>;
extern template struct Motion<3>;

}  // namespace abut
