#pragma once

// Which four of many places span most.

#include <array>
#include <cstddef>
#include <span>

namespace abut {

/// The numbers of `first` and of the three that make the largest quadrilateral with it: for each that may lie opposite,
/// the two that are farthest to either side of the diagonal. A number is there twice where fewer make it as large. Of
/// places in a row, the two ends. Of those that are as good the lowest.
std::array<std::size_t, 4> largest_quadrilateral(std::span<const double> x, std::span<const double> y,
                                                 std::size_t first);

}  // namespace abut
