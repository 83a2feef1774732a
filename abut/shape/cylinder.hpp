#pragma once

// Cylinder and cone.

#include <abut/convex/support.hpp>

namespace abut {

/// A cylinder with flat ends. If a == b it is a disc perpendicular to the z axis.
struct Cylinder {
    Vec3 a{};          ///< the center of one end
    Vec3 b{};          ///< the center of the other
    float radius = 0;  ///< not below zero
};

/// If a == b it is a disc perpendicular to the z axis.
struct Cone {
    Vec3 a{};          ///< the center of the base
    Vec3 b{};          ///< the apex
    float radius = 0;  ///< of the base; not below zero
};

detail::Convex<3> convex(const Cylinder& cylinder);
detail::Convex<3> convex(const Cone& cone);

}  // namespace abut
