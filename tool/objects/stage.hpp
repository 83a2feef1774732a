#pragma once

// Stages: time intervals on which all motions are linear with constant angular velocity.

#include <abut/abut.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace abut::tool {

/// Motion of an object during a stage.
enum class StageMotion : std::uint8_t {
    rests,
    moves,
    discontinuous,  ///< not present, its shape changes, or it jumps
};

/// A time interval on which every object translates and rotates uniformly, to within a fraction of the tolerated depth.
template <int D>
struct Stage {
    double from = 0, to = 0;         ///< seconds
    std::vector<StageMotion> parts;  ///< per object
    std::vector<Motion<D>> motions;  ///< per object, in its shape's frame; an object at rest has its pose only
};

/// Upper bound of the distance that any point of the shape moves during the stage. `reach` is the shape's maximum
/// distance from its origin.
inline double speed(const Motion<2>& motion, double reach) {
    return static_cast<double>(glm::length(motion.move)) + reach * std::abs(static_cast<double>(motion.turn));
}
inline double speed(const Motion<3>& motion, double reach) {
    return static_cast<double>(glm::length(motion.move)) + reach * static_cast<double>(glm::length(motion.turn));
}

}  // namespace abut::tool
