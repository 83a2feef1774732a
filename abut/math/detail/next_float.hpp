#pragma once

// The adjacent floats, equal to std::nextafter but inline.

#include <bit>
#include <cstdint>
#include <limits>

namespace abut::detail {

/// Without a branch: 1 for the bits of a positive float, and -1 for those of a negative one. Adding it is a step up.
inline std::int32_t step_up(std::int32_t bits) {
    return bits >> 31 | 1;
}

/// The smallest float above x; infinity and NaN are unchanged.
inline float next_up(float x) {
    if (!(x < std::numeric_limits<float>::infinity())) return x;
    // Turns -0 into 0.
    const auto bits = std::bit_cast<std::int32_t>(x + 0.0f);
    return std::bit_cast<float>(bits + step_up(bits));
}

/// The largest float below x; minus infinity and NaN are unchanged.
inline float next_down(float x) {
    return -next_up(-x);
}

}  // namespace abut::detail
