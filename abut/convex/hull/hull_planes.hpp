#pragma once

// The planes of a hull's faces, moved outwards until no input point is outside.

#include <abut/convex/hull/hull_faces.hpp>
#include <abut/convex/hull/hull_grid.hpp>

#include <span>
#include <vector>

namespace abut::detail {

/// One per face: dot(normal, p) <= offset for all points, including those that the hull left out, evaluated in double.
/// Along an axis it is the smallest such number. Otherwise it is larger by at most `surface.left_out`, two steps of the
/// grid, and some roundings of double if every point is on the grid. O(n), unless many faces and triangles share one
/// corner: then it is the product of the two.
std::vector<double> plane_offsets(const HullFaces& faces, std::span<const Vec3> points, const HullGrid& grid,
                                  const TriangleSurface& surface);

}  // namespace abut::detail
