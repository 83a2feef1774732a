#pragma once

// Conversions to Box2D's types. Included by files that use Box2D.

#include <abut/math/aabb.hpp>
#include <abut/math/pose.hpp>

#include <box2d/b2_collision.h>
#include <box2d/b2_math.h>

namespace abut::bench {

inline b2Vec2 to_box2d(const Vec2& v) {
    return {v.x, v.y};
}

inline b2Transform to_box2d(const Pose2& pose) {
    b2Transform result;
    result.p = to_box2d(pose.position);
    result.q.c = pose.rotation.cos;
    result.q.s = pose.rotation.sin;
    return result;
}

inline b2AABB to_box2d(const Aabb2& box) {
    return {to_box2d(box.min), to_box2d(box.max)};
}

}  // namespace abut::bench
