#pragma once

// The outline (silhouette) of a convex set along a direction. For the drawing functions.

#include <abut/convex/support.hpp>

#include <vector>

namespace abut::detail {

/// The directions whose support points make the outline: cos * x + sin * y + tilt. The tilt makes all of them choose
/// the same end of a shape with two, such as a cylinder along it.
template <int D>
struct OutlinePlane {
    DVec<D> x, y;       ///< unit length, at right angles
    DVec<D> tilt{0.0};  ///< short, out of the plane of x and y
};

/// The closed outline, counter-clockwise from x to y: in 2D the boundary of the set, in 3D a closed line on its
/// surface. Curves have an error of at most 1/800 of the set's size. Polygons keep their corners, except for those
/// within 1e-6 of the size of the line between others. A point has one point, a segment two.
template <int D>
std::vector<Vec<D>> outline(const Convex<D>& convex, const OutlinePlane<D>& plane);

/// The outline in the plane.
std::vector<Vec2> outline(const Convex<2>& convex);

}  // namespace abut::detail
