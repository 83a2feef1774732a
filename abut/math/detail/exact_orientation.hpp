#pragma once

// Exact orientations of points in double, such as the placed corners of a mesh: a filter, then expansion arithmetic.
// Coordinates are finite, and zero or from 2^-150 to 2^150 in magnitude, as all floats are. They never allocate. For
// .cpp files.

#include <abut/math/vec.hpp>

namespace abut::detail {

/// The side of plane abc on which d lies: 1 on the side of cross(b - a, c - a), -1 on the other side, 0 if the points
/// are coplanar.
int exact_side(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, const DVec<3>& d);

/// The orientation of triangle abc: 1 counter-clockwise, -1 clockwise, 0 if the points are collinear.
int exact_turn(const DVec<2>& a, const DVec<2>& b, const DVec<2>& c);

/// The orientation of triangle abc seen along an axis, from its positive end: 1 counter-clockwise, -1 clockwise, 0 if
/// the projected points are collinear.
int exact_turn(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, int axis);

}  // namespace abut::detail
