#pragma once

// Convex decomposition of outlines with holes.

#include <abut/math/point_span.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/polygon.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

/// Properties of an outline and of its decomposition.
struct OutlineReport {
    std::size_t repeated_points = 0;  ///< removed: at the position of the previous point
    /// repeated visits of the boundary to a point, where it touches or overlaps itself
    std::size_t touching_points = 0;
    std::size_t cancelled_edges = 0;  ///< removed: edges that the boundary traverses in both directions, as at a spike
    std::size_t idle_holes = 0;       ///< removed: outside the outline, or in other holes
    std::size_t filled_holes = 0;     ///< removed: holes no longer than `OutlineOptions::concavity`
    std::size_t reflex_corners = 0;   ///< corners of the region with an interior angle above 180 degrees
    std::size_t pieces = 0;
    std::size_t min_pieces = 0;  ///< lower bound of the number of exact pieces with cuts between corners
    /// pieces so thin that they are segments: a `Polygon` has no area within the rounding of its corners
    std::size_t thin_pieces = 0;
    bool optimal = false;   ///< the exact partition has the minimum number of pieces, given cuts between corners
    double area = 0;        ///< of the outline without its holes
    double area_added = 0;  ///< area of the parts minus that of the pieces of which they are the hulls
};

struct OutlineOptions {
    /// 0: exact. Else a length: a part is the hull of a piece whose corners lie at most this deep below the hull's
    /// edges. There are fewer parts, which may extend beyond the outline and overlap. Holes with a bounding box of at
    /// most this size are filled.
    double concavity = 0;
    /// No corner of a part lies within an edge of another. For exact parts only.
    bool conforming = false;
    OutlineReport* report = nullptr;
};

/// Decomposes an outline with holes into convex parts that cover it exactly and don't overlap. All cuts run between
/// corners of the input. The corners of the parts are input points, bit by bit (-0 becomes 0). All decisions are exact.
///
/// Rings are closed, without their first point repeated, in either direction. The even-odd rule decides what is inside
/// a ring. Rings may touch themselves and each other in points and along edges, and holes may lie in one another.
/// Repeated points and spikes are removed. Edges that cross are a Problem (`bad_argument`, with the number of an edge's
/// first point in its ring; the message names both edges and the place), because a cut there would need a new point.
/// Other Problems: no points (`empty_input`), a point that isn't finite (`not_finite`, its number in its ring), an
/// empty interior (`degenerate`), options outside their limits (`bad_argument`).
///
/// A ring of up to 128 corners without holes is partitioned into the minimum number of parts (Keil and Snoeyink 2002:
/// "On the time bound for convex decomposition of simple polygons"; here O(n^3)). Others are triangulated by a plane
/// sweep, unnecessary edges are removed (Hertel and Mehlhorn 1983), and the partition is improved patch by patch: O(n
/// log n).
///
/// With `conforming`, straight corners that several parts share stay corners: two parts are not merged if a third one's
/// corner would then lie within an edge. A straight corner of the outline that belongs to only one part is not a corner
/// of that part.
Result<std::vector<Polygon>> decompose(const PointSpan<2>& outline, std::span<const std::vector<Vec2>> holes = {},
                                       const OutlineOptions& options = {});

}  // namespace abut
