#pragma once

// The hull of points in double, as triangles.

#include <abut/convex/hull/quickhull.hpp>

#include <optional>
#include <span>
#include <vector>

namespace abut::detail {

struct ConvexSurface {
    std::vector<DVec<3>> points;  ///< each is a corner of a triangle
    TriangleSurface triangles;
};

/// A point within `tolerance` times the extent may be left outside of the surface, and a point in a face or an edge may
/// be a corner. The surface is convex to 2^-28 of the extent, the grid's step. Nothing if the points are flat.
std::optional<ConvexSurface> convex_surface(std::span<const DVec<3>> points, double tolerance);

}  // namespace abut::detail
