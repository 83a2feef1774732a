#pragma once

// Conversions to Bullet's types. Included by files that use Bullet.

#include <abut/math/aabb.hpp>
#include <abut/math/pose.hpp>

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <LinearMath/btTransform.h>

namespace abut::bench {

inline btVector3 to_bullet(const Vec3& v) {
    return {v.x, v.y, v.z};
}

inline btTransform to_bullet(const Pose3& pose) {
    const glm::quat& q = pose.rotation;
    return btTransform(btQuaternion(q.x, q.y, q.z, q.w), to_bullet(pose.position));
}

inline btDbvtVolume to_bullet(const Aabb3& box) {
    return btDbvtVolume::FromMM(to_bullet(box.min), to_bullet(box.max));
}

}  // namespace abut::bench
