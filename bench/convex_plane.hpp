#pragma once

// The sides that take outlines apart.

#include "bench.hpp"
#include <abut/math/vec.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut::bench {

/// Of a ring, as doubles have it; above zero where it is counter-clockwise.
double area_of(std::span<const Vec2> ring);

/// How many parts there are; NaN where they are together larger or smaller than what they should cover.
double count_if_covered(std::size_t count, double area, double expected);

Side cgal_greene(const std::vector<Vec2>& outline);
Side cgal_approximate(const std::vector<Vec2>& outline);
Side cgal_optimal(const std::vector<Vec2>& outline);

}  // namespace abut::bench
