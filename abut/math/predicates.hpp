#pragma once

// Questions about the position of points whose answers are exact, whatever finite floats come in: a filter in double
// with a proved error bound, then expansions of doubles that don't round (Shewchuk: "Adaptive precision floating-point
// arithmetic and fast robust geometric predicates", 1997). They never allocate.

#include <abut/math/vec.hpp>

namespace abut {

/// The turn from ab to ac: 1 if the triangle abc is counter-clockwise, -1 if it is clockwise, 0 if the three lie on a
/// line.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// The side of the plane abc that d lies on: 1 if abc is counter-clockwise seen from d (d is where cross(b - a, c - a)
/// points to), -1 if it is clockwise, 0 if the four lie in a plane.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The turn from ab to ac, where c is told in double: zero, or coordinates from 2^-300 to 2^300.
int turn_towards(const Vec2& a, const Vec2& b, const DVec<2>& c);

/// Whether p lies on the line through a and b, between them or beyond; always where a == b.
bool on_line(const Vec2& a, const Vec2& b, const Vec2& p);
bool on_line(const Vec3& a, const Vec3& b, const Vec3& p);

/// Whether p lies in the plane through a, b and c; always where these three are on a line.
bool in_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

/// The sign of a + b + c: -1, 0 or 1. They are finite, and so are their sums.
int sign_of_sum(double a, double b, double c);

}  // namespace abut
