#pragma once

// Warm start: the last simplex and separating axis of a pair, from which its next query begins.

#include <array>
#include <cstdint>

namespace abut {

/// The caller owns one cache for each pair of shapes and passes it to each query about the pair. A new cache is empty.
/// It saves time while both shapes keep their vertices and move little between queries. It never changes whether an
/// answer is right, but the last digits of the answer may differ.
struct Cache {
    std::array<std::uint32_t, 4> corner_a{}, corner_b{};  ///< vertex indices of the last simplex
    std::uint32_t count = 0;                              ///< of the points of the simplex
    std::array<float, 3> axis{};                          ///< the last separating axis, from A to B; zero: none
};

}  // namespace abut
