#pragma once

// The sides that decompose polygons.

#include "../bench.hpp"
#include <abut/math/vec.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut::bench {

/// The signed area of a ring in double; positive if counter-clockwise.
double area_of(std::span<const Vec2> ring);

/// The count of parts; NaN if their total area differs from the polygon's.
double count_if_covered(std::size_t count, double area, double expected);

Side cgal_greene(const std::vector<Vec2>& outline);
Side cgal_approximate(const std::vector<Vec2>& outline);
Side cgal_optimal(const std::vector<Vec2>& outline);

}  // namespace abut::bench
