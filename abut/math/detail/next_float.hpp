#pragma once

// The adjacent floats, equal to std::nextafter but inline.

#include <bit>
#include <cstdint>
#include <limits>

namespace abut::detail {

/// The smallest float above x; infinity and NaN are unchanged.
inline float next_up(float x) {
    if (!(x < std::numeric_limits<float>::infinity())) return x;
    // Turns -0 into 0.
    const auto bits = std::bit_cast<std::uint32_t>(x + 0.0f);
    return std::bit_cast<float>(x < 0 ? bits - 1 : bits + 1);
}

/// The largest float below x; minus infinity and NaN are unchanged.
inline float next_down(float x) {
    return -next_up(-x);
}

}  // namespace abut::detail
