#pragma once

// The grid that hulls in space are built on.

#include <abut/convex/quickhull.hpp>

#include <span>
#include <vector>

namespace abut {

/// Points rounded to a grid whose steps are a power of two, so that those of a coarser grid stay where they are.
struct Grid {
    std::vector<GridPoint> points;
    DVec<3> least, greatest;             ///< the corners of the bounding box, as the points are; `least` is the origin
    double step = 0;                     ///< the length of a step
    DVec<3> rounding{0.0};               ///< the most that a point was moved along each axis, in steps
    double tolerance = 0, flatness = 0;  ///< hull_tolerance and hull_flatness, in steps
};

/// Of points that are not all the same.
Grid on_grid(std::span<const Vec3> points);
Grid on_grid(std::span<const DVec<3>> points);

}  // namespace abut
