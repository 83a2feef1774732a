#pragma once

// The answer of raycasts and sweeps.

#include <abut/math/vec.hpp>
#include <abut/query/feature.hpp>

namespace abut {

/// The first contact gained by a motion.
template <int D>
struct Hit {
    float fraction = 0;           ///< of the motion, in [0, 1]; 0 for a ray of infinite length
    float distance = 0;           ///< along the motion
    Vec<D> point{};               ///< the point of contact at that moment
    Vec<D> normal{};              ///< unit vector, facing the mover or the ray's origin
    bool started_inside = false;  ///< the start is deeper inside than the tolerance
    Feature feature{};            ///< of the shape that is hit
};

}  // namespace abut
