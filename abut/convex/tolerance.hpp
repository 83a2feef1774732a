#pragma once

// The tolerance of answers about two parts. For .cpp files.

namespace abut::detail {

/// Sixteen units in the last place of a float, relative to its value: one such unit is at least 2^-24 of it.
inline constexpr double sixteen_ulp = 16 * 0x1p-24;

/// The tolerance of a pair, from the size of the smaller part and the largest coordinate of either relative to A.
inline double tolerance_for(double smaller_size, double largest_coordinate) {
    return 1e-5 * smaller_size + sixteen_ulp * largest_coordinate;
}

}  // namespace abut::detail
