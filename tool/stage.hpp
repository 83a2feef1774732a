#pragma once

// How objects get from one moment to the next.

#include <abut/abut.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace abut::tool {

/// How an object takes part in a stage.
enum class Part : std::uint8_t {
    rests,
    moves,
    unfollowed,  ///< it isn't there, its shape changes, or it jumps
};

/// A part of the way, on which each object goes straight on and turns evenly, to within a fraction of what is allowed.
template <int D>
struct Stage {
    double from = 0, to = 0;         ///< seconds
    std::vector<Part> parts;         ///< of each object
    std::vector<Motion<D>> motions;  ///< of each object, in its shape's frame; for one that rests its pose alone
};

/// How fast any place of a shape can go on the way, in lengths a stage. `reach` is from its origin.
inline double speed(const Motion<2>& motion, double reach) {
    return static_cast<double>(glm::length(motion.move)) + reach * std::abs(static_cast<double>(motion.turn));
}
inline double speed(const Motion<3>& motion, double reach) {
    return static_cast<double>(glm::length(motion.move)) + reach * static_cast<double>(glm::length(motion.turn));
}

}  // namespace abut::tool
