#pragma once

// The overlap of two polytopes, as a polytope.

#include <abut/query/options.hpp>
#include <abut/query/polytope.hpp>

#include <optional>

namespace abut {

bool intersection(const Convex<2>& a, const Convex<2>& b, Polygon& out, const QueryOptions<2>& options = {});
bool intersection(const Convex<3>& a, const Convex<3>& b, Polyhedron& out, const QueryOptions<3>& options = {});

/// All points that are in both, as a Polygon or Polyhedron with its area or volume, centroid and normal; false, and
/// `out` as it was, where there are none: it is true where `overlaps` is. What touches has in common a face, an edge or
/// a point, and `out` is then that, of less rank. One shape inside of the other comes back as it is.
///
/// A and B are polytopes; of others, `polytope(shape, tolerance)` makes one. The result is right to within the margin
/// of doubt, and then rounded to floats, which far from the origin may move its corners, and lift them out of a plane,
/// by as much as floats are apart there. What reaches beyond all floats, isn't finite, or is a view of a shape that is
/// no polytope, trips ABUT_ASSERT; in release the answer is then false. `options.trace` is told each cut.
template <PolytopeShape A, PolytopeShape B>
requires(dimension<A> == dimension<B>) bool intersection(const A& a, const B& b, PolytopeOf<dimension<A>>& out,
                                                         const QueryOptions<dimension<A>>& options = {}) {
    const auto& corners_a = detail::by_corners(a);
    const auto& corners_b = detail::by_corners(b);
    const Convex<dimension<A>>& seen_a = view(corners_a);
    const Convex<dimension<A>>& seen_b = view(corners_b);
    detail::clear_upper_halves();
    return intersection(seen_a, seen_b, out, options);
}

/// The same; nothing where no point is in both.
template <PolytopeShape A, PolytopeShape B>
requires(dimension<A> == dimension<B>) std::optional<PolytopeOf<dimension<A>>> intersection(
    const A& a, const B& b, const QueryOptions<dimension<A>>& options = {}) {
    PolytopeOf<dimension<A>> out;
    if (!intersection(a, b, out, options)) return std::nullopt;
    return out;
}

}  // namespace abut
