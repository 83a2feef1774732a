#pragma once

// The Minkowski sum and Minkowski difference of two polytopes, as polytopes.

#include <abut/query/polytope.hpp>

namespace abut {

/// All points p + q, p in A and q in B: A swept over B. The result is convex, and each of its corners is a corner of A
/// plus one of B, rounded to floats. A and B are polytopes; for other shapes, `polytope(shape, tolerance)` makes one.
/// In space, corners within 1e-6 of the extent of A + B of other corners may be left out. Cost for n and m corners,
/// besides building the result: n + m steps in the plane, n m in space. A number that isn't finite, a sum beyond the
/// range of floats, or a view of a shape that is no polytope trips ABUT_ASSERT; in release the result is then some
/// polytope.
Polygon minkowski_sum(const detail::Convex<2>& a, const detail::Convex<2>& b);
Polyhedron minkowski_sum(const detail::Convex<3>& a, const detail::Convex<3>& b);

template <PolytopeShape A, PolytopeShape B>
requires(dimension<A> == dimension<B>) PolytopeOf<dimension<A>> minkowski_sum(const A& a, const B& b) {
    const auto& corners_a = detail::by_corners(a);
    const auto& corners_b = detail::by_corners(b);
    const detail::Convex<dimension<A>>& view_a = view(corners_a);
    const detail::Convex<dimension<A>>& view_b = view(corners_b);
    detail::clear_upper_halves();
    return minkowski_sum(view_a, view_b);
}

/// All points p - q, p in A and q in B: the translations of B that move q to p. A and B overlap exactly if it contains
/// 0, and their gap or depth is the distance of 0 from its surface. Otherwise like the sum.
Polygon minkowski_difference(const detail::Convex<2>& a, const detail::Convex<2>& b);
Polyhedron minkowski_difference(const detail::Convex<3>& a, const detail::Convex<3>& b);

template <PolytopeShape A, PolytopeShape B>
requires(dimension<A> == dimension<B>) PolytopeOf<dimension<A>> minkowski_difference(const A& a, const B& b) {
    const auto& corners_a = detail::by_corners(a);
    const auto& corners_b = detail::by_corners(b);
    const detail::Convex<dimension<A>>& view_a = view(corners_a);
    const detail::Convex<dimension<A>>& view_b = view(corners_b);
    detail::clear_upper_halves();
    return minkowski_difference(view_a, view_b);
}

}  // namespace abut
