#pragma once

// Cylinder and cone: round things with an axis and sharp rims.

#include <abut/convex/support.hpp>

namespace abut {

/// Flat at both ends. Where a == b, a disc at right angles to the z axis.
struct Cylinder {
    Vec3 a{};          ///< the centre of one end
    Vec3 b{};          ///< the centre of the other
    float radius = 0;  ///< not below zero
};

/// Where a == b, a disc at right angles to the z axis.
struct Cone {
    Vec3 a{};          ///< the centre of the base
    Vec3 b{};          ///< the apex
    float radius = 0;  ///< of the base; not below zero
};

Convex<3> convex(const Cylinder& cylinder);
Convex<3> convex(const Cone& cone);

}  // namespace abut
