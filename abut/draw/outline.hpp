#pragma once

// The outline of a convex set as seen along a direction. For the drawing functions.

#include <abut/convex/support.hpp>

#include <vector>

namespace abut {

/// The directions whose farthest points make up an outline: cos * x + sin * y + tilt. The tilt makes them all choose
/// the same end of a shape with two, such as a cylinder along it.
template <int D>
struct OutlinePlane {
    DVec<D> x, y;       ///< of length 1, at right angles
    DVec<D> tilt{0.0};  ///< short, out of the plane of both
};

/// The closed outline, counter-clockwise from x to y: the set's own boundary in 2D; in 3D a closed line on its surface.
/// Curves are right to 1/800 of the set's size. Polygons have their own corners, but for those within 1e-6 of the size
/// of the line between others. One point where the set is one, two for a segment.
template <int D>
std::vector<Vec<D>> outline(const Convex<D>& convex, const OutlinePlane<D>& plane);

/// In 2D there is but one plane.
std::vector<Vec2> outline(const Convex<2>& convex);

}  // namespace abut
