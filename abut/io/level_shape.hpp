#pragma once

// Converts the primitives of drawings, transformed by any affine map, to shapes; exactly if a shape type fits.

#include <abut/io/level.hpp>
#include <abut/math/affine.hpp>
#include <abut/math/result.hpp>

#include <span>
#include <vector>

namespace abut::detail {

/// A shape with its pose.
struct PlacedShape {
    LevelShape shape;
    Pose2 pose;
    bool filled = false;  ///< as in LevelObject
};

/// All functions below return a Problem of code `degenerate` if the shape has no extent left, and of code `not_finite`
/// if a coordinate is out of the range of floats. `tolerance` is the maximum distance of a polyline from the curve that
/// it approximates, before the map is applied.

/// A rectangle from the origin to `size`. A map with skew makes it a polygon.
Result<PlacedShape> place_rectangle(const Affine<2>& map, const DVec<2>& size);

/// A rectangle from the origin to `size` with corners rounded by quarter ellipses of these radii, at most half of the
/// size.
Result<PlacedShape> place_rounded_rectangle(const Affine<2>& map, const DVec<2>& size, const DVec<2>& radii,
                                            double tolerance);

/// An ellipse around the origin. It stays an ellipse under any affine map.
Result<PlacedShape> place_ellipse(const Affine<2>& map, const DVec<2>& radii);

/// A polyline through the points. It has an area if it is `closed` and `filled`, and is then a Polygon if it is convex.
/// Consecutive equal points are merged.
Result<PlacedShape> place_polyline(const Affine<2>& map, std::span<const DVec<2>> points, bool closed, bool filled);

/// A compound of several shapes; a single shape is returned unchanged.
Result<PlacedShape> join_shapes(std::vector<PlacedShape> shapes);

/// A type-erased copy of the shape at its pose.
AnyShape<2> any_shape(const PlacedShape& shape);

/// Rotation in degrees, clockwise where y points down. Exact for multiples of 90 degrees.
Affine<2> rotation_by(double degrees);
Affine<2> translation_by(const DVec<2>& by);
Affine<2> scaling_by(const DVec<2>& by);

/// The corners of a polygon that approximates a rounded rectangle from the origin to `size`, counter-clockwise where y
/// points up.
std::vector<DVec<2>> rounded_rectangle_points(const DVec<2>& size, const DVec<2>& radii, double tolerance);

}  // namespace abut::detail
