#pragma once

// The overlap of two polytopes, as a polytope.

#include <abut/query/options.hpp>
#include <abut/query/polytope.hpp>

#include <optional>

namespace abut {

bool intersection(const detail::Convex<2>& a, const detail::Convex<2>& b, Polygon& out,
                  const QueryOptions<2>& options = {});
bool intersection(const detail::Convex<3>& a, const detail::Convex<3>& b, Polyhedron& out,
                  const QueryOptions<3>& options = {});

/// Writes all points that are in both to `out`, a Polygon or Polyhedron with area or volume, centroid and normal.
/// Returns whether there are any, exactly as `overlaps`; if not, `out` stays as it was. Touching shapes share a face,
/// an edge or a point, and `out` is then of that lower rank. If one shape contains the other, the result is the inner
/// one.
///
/// A and B are polytopes; for other shapes, `polytope(shape, tolerance)` makes one. The result is right to within the
/// tolerance, and then rounded to floats: far from the origin that may move its corners, and lift them out of a plane,
/// by the spacing of floats there. Shapes beyond the range of floats, not finite, or views of shapes that are no
/// polytopes trip ABUT_ASSERT; in release the answer is then false. `options.trace` records each cut.
template <PolytopeShape A, PolytopeShape B>
requires(dimension<A> == dimension<B>) bool intersection(const A& a, const B& b, PolytopeOf<dimension<A>>& out,
                                                         const QueryOptions<dimension<A>>& options = {}) {
    const auto& corners_a = detail::by_corners(a);
    const auto& corners_b = detail::by_corners(b);
    const detail::Convex<dimension<A>>& view_a = view(corners_a);
    const detail::Convex<dimension<A>>& view_b = view(corners_b);
    detail::clear_upper_halves();
    return intersection(view_a, view_b, out, options);
}

/// The intersection as a value; std::nullopt if no point is in both.
template <PolytopeShape A, PolytopeShape B>
requires(dimension<A> == dimension<B>) std::optional<PolytopeOf<dimension<A>>> intersection(
    const A& a, const B& b, const QueryOptions<dimension<A>>& options = {}) {
    PolytopeOf<dimension<A>> out;
    if (!intersection(a, b, out, options)) return std::nullopt;
    return out;
}

}  // namespace abut
