#pragma once

// How far an answer about two parts may be off. For .cpp files.

namespace abut {

/// Sixteen units in the last place of a float, in parts of it: such a unit is 2^-24 of it at least.
inline constexpr double sixteen_ulp = 16 * 0x1p-24;

/// The margin of doubt: of the smaller one's size, and of the largest coordinate of either, seen from the first.
inline double margin_of_doubt(double smaller_size, double largest_coordinate) {
    return 1e-5 * smaller_size + sixteen_ulp * largest_coordinate;
}

}  // namespace abut
