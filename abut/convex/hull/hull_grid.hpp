#pragma once

// The integer grid that hulls in space are built on, and the affine rank of points on it.

#include <abut/convex/hull/quickhull.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// Points rounded to a grid whose steps are a power of two, so that points on a coarser grid don't move.
struct HullGrid {
    std::vector<GridPoint> points;
    DVec<3> least, greatest;             ///< of the bounding box of the unrounded points; `least` is the origin
    double step = 0;                     ///< the length of a step
    DVec<3> rounding{0.0};               ///< the maximum rounding of a point along each axis, in steps
    double tolerance = 0, flatness = 0;  ///< hull_tolerance and hull_flatness, in steps
};

/// The points are not all equal.
HullGrid on_grid(std::span<const Vec3> points);
HullGrid on_grid(std::span<const DVec<3>> points);

/// The affine rank of the set, and rank + 1 points that span it: two distant points, the farthest from their line, and
/// the farthest from the plane of the three. A distance of at most `tolerance` (in steps of the grid) counts as zero.
struct Spread {
    std::array<std::uint32_t, 4> points{};
    int rank = 0;
};

Spread spread_of(const HullGrid& grid, double tolerance);

}  // namespace abut::detail
