#pragma once

// The points of the plane that a hull has to look at, in order.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// One of the points, without a way to look it up: they are far apart in memory.
struct NumberedPoint {
    Vec2 point{0.0f};
    std::uint32_t number = 0;
};

/// The points of one x that can be corners: the lowest and the highest, of copies the first. They may be the same.
struct HullColumn {
    NumberedPoint lowest, highest;
};

/// Columns by growing x, left out those that are surely strictly inside of eight points far out (Akl, Toussaint: "A
/// fast convex hull algorithm", 1978). The points are finite; there is at least one. O(n).
std::vector<HullColumn> hull_columns(std::span<const Vec2> points);

}  // namespace abut
