#pragma once

// The candidate corners of a hull in 2D, in order.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// A copy of a point, because the points are far apart in memory.
struct NumberedPoint {
    Vec2 point{0.0f};
    std::uint32_t number = 0;
};

/// The candidates with one x: the lowest and the highest, of copies the first. They may be equal.
struct HullColumn {
    NumberedPoint lowest, highest;
};

/// Columns by increasing x, without the points that are surely inside of eight extreme points (Akl, Toussaint: "A fast
/// convex hull algorithm", 1978). The points are finite; there is at least one. O(n).
std::vector<HullColumn> hull_columns(std::span<const Vec2> points);

}  // namespace abut::detail
