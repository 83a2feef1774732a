#pragma once

// From the outlines that drawings are made of, placed by any affine map, to shapes: exactly where there is one.

#include <abut/io/level.hpp>
#include <abut/math/linear.hpp>
#include <abut/math/result.hpp>

#include <span>
#include <vector>

namespace abut {

/// A shape in its place.
struct PlacedShape {
    LevelShape shape;
    Pose2 pose;
    bool filled = false;  ///< as in LevelObject
};

/// Of these, a Problem is of code `degenerate` where nothing is left to touch, or `not_finite` where a coordinate is
/// beyond the range of floats. `tolerance` is how far a line may be from the curve that it stands for, before the map.

/// From the origin to `size`; at an angle to itself after a skew, and a polygon then.
Result<PlacedShape> place_rectangle(const Affine<2>& map, const DVec<2>& size);

/// The same with round corners: by quarters of an ellipse with these radii, at most half of the size.
Result<PlacedShape> place_rounded_rectangle(const Affine<2>& map, const DVec<2>& size, const DVec<2>& radii,
                                            double tolerance);

/// Around the origin. An ellipse stays one whatever the map.
Result<PlacedShape> place_ellipse(const Affine<2>& map, const DVec<2>& radii);

/// A line through the points; one with an area if it is closed and `filled`: a polygon where that is convex. Points
/// that are the same as the one before are left out.
Result<PlacedShape> place_line(const Affine<2>& map, std::span<const DVec<2>> points, bool closed, bool filled);

/// Several shapes as one: of one, that one.
Result<PlacedShape> joined(std::vector<PlacedShape> shapes);

/// As a value of its own.
AnyShape<2> any_shape(const PlacedShape& shape);

/// Turned by degrees, clockwise where y points down; by quarters of a turn exactly.
Affine<2> turned(double degrees);
Affine<2> shifted(const DVec<2>& by);
Affine<2> scaled(const DVec<2>& by);

/// A rectangle from the origin to `size` with round corners, as points, counter-clockwise where y points up.
std::vector<DVec<2>> rounded_outline(const DVec<2>& size, const DVec<2>& radii, double tolerance);

}  // namespace abut
