#pragma once

// Conversions to FCL's types. Included by files that use FCL.

#include <abut/math/pose.hpp>

#include <fcl/common/types.h>

namespace abut::bench {

inline fcl::Vector3d to_fcl(const Vec3& v) {
    return {v.x, v.y, v.z};
}

inline fcl::Transform3d to_fcl(const Pose3& pose) {
    const glm::quat& q = pose.rotation;
    fcl::Transform3d result = fcl::Transform3d::Identity();
    result.linear() = fcl::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
    result.translation() = to_fcl(pose.position);
    return result;
}

}  // namespace abut::bench
