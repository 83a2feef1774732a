#pragma once

// The answer of the questions about motion: rays and sweeps.

#include <abut/math/vec.hpp>
#include <abut/query/feature.hpp>

namespace abut {

/// Contact gained by a motion.
template <int D>
struct Hit {
    float fraction = 0;           ///< of the motion, in [0, 1]; 0 for a ray of infinite length
    float distance = 0;           ///< along the motion
    Vec<D> point{};               ///< where they touch at that moment
    Vec<D> normal{};              ///< of length 1, facing the mover or the ray's origin
    bool started_inside = false;  ///< the motion started deeper in than rounding explains
    Feature feature{};            ///< of what is hit
};

}  // namespace abut
