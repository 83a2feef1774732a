#pragma once

// Poses from the matrices that other code keeps them in: an engine's transforms, the nodes of a model.

#include <abut/math/pose.hpp>
#include <abut/math/result.hpp>

#include <glm/ext/matrix_float3x3.hpp>
#include <glm/ext/matrix_float4x4.hpp>

namespace abut {

/// The pose of a homogeneous matrix that rotates and moves, by columns as glm has them. A rotation that rounding has
/// moved by up to 1e-4 is accepted, and the nearest rotation taken for it; the quaternion has length 1 and w >= 0.
///
/// A Problem for all else: a number that isn't finite, a last row that isn't 0 .. 0 1 (a projection), an axis whose
/// length isn't 1 (a scale), axes that aren't at right angles (a shear), and a mirror. Its index is the axis. A scale
/// belongs to the shape: stretched(shape, scale).
Result<Pose2> pose_from(const glm::mat3& matrix);
Result<Pose3> pose_from(const glm::mat4& matrix);

}  // namespace abut
