#pragma once

// The planes of a hull's faces: pushed out until no input point is outside.

#include <abut/convex/hull_faces.hpp>
#include <abut/convex/hull_grid.hpp>

#include <span>
#include <vector>

namespace abut {

/// One a face: dot(normal, p) <= offset for every one of the points, also for those that the hull left out, evaluated
/// in double. It is the least such number where the normal lies along an axis. Else it is above that by no more than
/// `surface.left_out` and two steps of the grid, and by a few roundings of double where every point is one of the grid.
/// O(n) but for faces and triangles that meet in one corner in great numbers, where it is the product of the two.
std::vector<double> plane_offsets(const HullFaces& faces, std::span<const Vec3> points, const Grid& grid,
                                  const TriangleSurface& surface);

}  // namespace abut
