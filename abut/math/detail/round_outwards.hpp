#pragma once

// Doubles to floats, rounded down or up, and the spacing of floats. For .cpp files.

#include <abut/math/detail/next_float.hpp>

#include <bit>
#include <cstdint>

namespace abut::detail {

/// The largest float that is not above x; NaN for NaN. There is no branch, as none could predict on which side of x the
/// nearest float lies.
inline float float_at_most(double x) {
    const auto nearest = static_cast<float>(x);
    const auto bits = std::bit_cast<std::int32_t>(nearest);
    const std::int32_t is_above = static_cast<double>(nearest) > x;
    return std::bit_cast<float>(bits - (step_up(bits) & -is_above));
}

/// The smallest float that is not below x; NaN for NaN.
inline float float_at_least(double x) {
    return -float_at_most(-x);
}

/// The distance from the float nearest to x to the next one away from 0: a unit in the last place.
inline double float_spacing(double x) {
    const auto nearest = static_cast<float>(x < 0 ? -x : x);
    return static_cast<double>(next_up(nearest)) - static_cast<double>(nearest);
}

}  // namespace abut::detail
