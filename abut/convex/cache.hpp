#pragma once

// Where a search ended, so that the next one for the same pair can begin there.

#include <array>
#include <cstdint>

namespace abut {

/// Kept by the caller, one for each pair of shapes, and handed to each question about it; a new one knows nothing. It
/// stays useful while both shapes keep their corners and move little between questions, and never does harm: an answer
/// with it is as right as without it, though its last digits may differ.
struct Cache {
    std::array<std::uint32_t, 4> corner_a{}, corner_b{};  ///< of the last simplex
    std::uint32_t count = 0;                              ///< of its points
    std::array<float, 3> axis{};                          ///< that parted them last, from A to B; zero: not known
};

}  // namespace abut
