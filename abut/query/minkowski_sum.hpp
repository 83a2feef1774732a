#pragma once

// All sums and all differences of the points of two polytopes, as polytopes.

#include <abut/query/polytope.hpp>

namespace abut {

/// All points p + q, p in A and q in B: A with B slid along its outside. Convex, and each of its corners is a corner of
/// A plus one of B, rounded to floats. A and B are polytopes; of others, `polytope(shape, tolerance)` makes one. In
/// space, corners that are within 1e-6 of the extent of A + B of the others may be left out. Takes n + m steps in the
/// plane and n m in space for n and m corners, besides building the result. A number that isn't finite, a sum beyond
/// the floats, or a view of what is no polytope trips ABUT_ASSERT; in release the result is then some polytope.
Polygon minkowski_sum(const Convex<2>& a, const Convex<2>& b);
Polyhedron minkowski_sum(const Convex<3>& a, const Convex<3>& b);

template <PolytopeShape A, PolytopeShape B>
requires(dimension<A> == dimension<B>) PolytopeOf<dimension<A>> minkowski_sum(const A& a, const B& b) {
    const auto& corners_a = detail::by_corners(a);
    const auto& corners_b = detail::by_corners(b);
    const Convex<dimension<A>>& seen_a = view(corners_a);
    const Convex<dimension<A>>& seen_b = view(corners_b);
    detail::clear_upper_halves();
    return minkowski_sum(seen_a, seen_b);
}

/// All points p - q, p in A and q in B: the ways to move B so that q comes to lie on p. A and B overlap exactly if 0 is
/// in it, and they are as far apart, or as deep in one another, as it is from its outside. Otherwise like the sum.
Polygon minkowski_difference(const Convex<2>& a, const Convex<2>& b);
Polyhedron minkowski_difference(const Convex<3>& a, const Convex<3>& b);

template <PolytopeShape A, PolytopeShape B>
requires(dimension<A> == dimension<B>) PolytopeOf<dimension<A>> minkowski_difference(const A& a, const B& b) {
    const auto& corners_a = detail::by_corners(a);
    const auto& corners_b = detail::by_corners(b);
    const Convex<dimension<A>>& seen_a = view(corners_a);
    const Convex<dimension<A>>& seen_b = view(corners_b);
    detail::clear_upper_halves();
    return minkowski_difference(seen_a, seen_b);
}

}  // namespace abut
