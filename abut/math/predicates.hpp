#pragma once

// Exact geometric predicates for any finite floats: a filter in double with a proved error bound, then expansion
// arithmetic (Shewchuk: "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997).
// They never allocate.

#include <abut/math/simd/upper_halves.hpp>
#include <abut/math/vec.hpp>

namespace abut {
namespace detail {

int triangle_orientation(const Vec2& a, const Vec2& b, const Vec2& c);
int tetrahedron_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace detail

/// The orientation of triangle abc: 1 if it is counter-clockwise, -1 if it is clockwise, 0 if the points are collinear.
inline int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
    detail::clear_upper_halves();
    return detail::triangle_orientation(a, b, c);
}

/// The side of plane abc on which d lies: 1 if abc is counter-clockwise seen from d (on the side of cross(b - a, c -
/// a)), -1 if it is clockwise, 0 if the points are coplanar.
inline int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    detail::clear_upper_halves();
    return detail::tetrahedron_orientation(a, b, c, d);
}

/// True if p lies on the line through a and b, also beyond them; always true if a == b.
bool on_line(const Vec2& a, const Vec2& b, const Vec2& p);
bool on_line(const Vec3& a, const Vec3& b, const Vec3& p);

/// True if p lies in the plane through a, b and c; always true if these are collinear.
bool in_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

}  // namespace abut

namespace abut::detail {

/// The orientation of triangle abc with c in double: each coordinate is 0 or from 2^-300 to 2^300 in magnitude.
int turn_towards(const Vec2& a, const Vec2& b, const DVec<2>& c);

/// The sign of a + b + c: -1, 0 or 1. The numbers and their sums are finite.
int sign_of_sum(double a, double b, double c);

}  // namespace abut::detail
