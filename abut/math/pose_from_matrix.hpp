#pragma once

// Poses from transformation matrices, such as an engine's transforms or the nodes of a model.

#include <abut/math/pose.hpp>
#include <abut/math/result.hpp>

#include <glm/ext/matrix_float3x3.hpp>
#include <glm/ext/matrix_float4x4.hpp>

namespace abut {

/// The pose of a homogeneous matrix of a rotation and a translation, in glm's column order. A rotation with errors up
/// to 1e-4 is accepted and replaced by the nearest rotation; the quaternion has length 1 and w >= 0.
///
/// Returns a Problem for anything else: a number that isn't finite, a last row that isn't 0 .. 0 1 (a projection), an
/// axis whose length isn't 1 (a scale), axes that aren't perpendicular (a shear), and a mirror (index: the axis). A
/// scale belongs to the shape: stretched(shape, scale).
Result<Pose2> pose_from(const glm::mat3& matrix);
Result<Pose3> pose_from(const glm::mat4& matrix);

}  // namespace abut
