#pragma once

// Manifold reduction: the four points that span the largest area.

#include <array>
#include <cstddef>
#include <span>

namespace abut::detail {

/// The indices of `first` and of the three points that make the largest quadrilateral with it. For each opposite point
/// these are the two farthest from the diagonal on either side. An index occurs twice if fewer points make as large an
/// area. For collinear points: the two ends. Of equal ones the lowest index.
std::array<std::size_t, 4> largest_quadrilateral(std::span<const double> x, std::span<const double> y,
                                                 std::size_t first);

}  // namespace abut::detail
