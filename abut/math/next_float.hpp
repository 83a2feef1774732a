#pragma once

// The floats next to one, as std::nextafter has them, without a call.

#include <bit>
#include <cstdint>
#include <limits>

namespace abut {

/// The least float above x; infinity and NaN as they are.
inline float next_up(float x) {
    if (!(x < std::numeric_limits<float>::infinity())) return x;
    // Of the two zeros the positive one.
    const auto bits = std::bit_cast<std::uint32_t>(x + 0.0f);
    return std::bit_cast<float>(x < 0 ? bits - 1 : bits + 1);
}

/// The greatest float below x; minus infinity and NaN as they are.
inline float next_down(float x) {
    return -next_up(-x);
}

}  // namespace abut
