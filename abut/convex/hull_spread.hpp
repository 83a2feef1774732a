#pragma once

// How flat a set of points is.

#include <abut/convex/hull_grid.hpp>

#include <array>
#include <cstdint>

namespace abut {

/// Rank + 1 points that span the set: two that are far apart, the one farthest from their line, the one farthest from
/// the plane of the three. What is no farther than `tolerance` (in steps of the grid) doesn't count.
struct Spread {
    std::array<std::uint32_t, 4> points{};
    int rank = 0;
};

Spread spread_of(const Grid& grid, double tolerance);

}  // namespace abut
