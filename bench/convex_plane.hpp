#pragma once

// The sides that take outlines apart.

#include "bench.hpp"
#include <abut/math/vec.hpp>

#include <span>
#include <vector>

namespace abut::bench {

/// How many parts there are; NaN where they don't cover the outline without its holes, by their areas.
double count_if_covered(std::span<const std::vector<Vec2>> parts, std::span<const Vec2> outline,
                        std::span<const std::vector<Vec2>> holes);

Side cgal_greene(const std::vector<Vec2>& outline);
Side cgal_approximate(const std::vector<Vec2>& outline);
Side cgal_optimal(const std::vector<Vec2>& outline);

}  // namespace abut::bench
