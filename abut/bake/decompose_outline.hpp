#pragma once

// Outlines of the plane as convex parts.

#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/polygon.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

/// What was done to an outline.
struct OutlineReport {
    std::size_t repeated_points = 0;  ///< left out: at the position of the point before
    std::size_t touching_points = 0;  ///< where the boundary comes by once more: it touches itself or runs along itself
    std::size_t cancelled_edges = 0;  ///< left out: the boundary goes along there and back, as at a spike
    std::size_t idle_holes = 0;       ///< left out: outside, or in other holes
    std::size_t filled_holes = 0;     ///< left out: no longer than `OutlineOptions::concavity`
    std::size_t reflex_corners = 0;   ///< of what is left: where the inside has more than half a turn
    std::size_t pieces = 0;
    std::size_t least_pieces = 0;  ///< no cuts between corners make fewer exact ones
    std::size_t thin_pieces = 0;   ///< are segments, because a `Polygon` as thin as the rounding of its corners is one
    bool optimal = false;          ///< no other cuts between corners make fewer exact pieces
    double area = 0;               ///< of the outline without its holes
    double area_added = 0;         ///< of the parts beyond that of the pieces that they are hulls of
};

struct OutlineOptions {
    /// 0: exact. Else a length: a part is the hull of a piece in which no corner lies deeper than this under the edge
    /// of the hull that it lies behind. Fewer parts, which cover more than the outline and may overlap. Holes whose box
    /// is no longer across than this are filled.
    double concavity = 0;
    /// No corner of a part lies within an edge of another. Only of exact parts.
    bool conforming = false;
    OutlineReport* report = nullptr;
};

/// Convex parts that cover exactly what lies in the outline and in no hole, and don't overlap. All cuts run between
/// corners of the input, and the corners of the parts are points of it, bit by bit (-0 becomes 0); all decisions are
/// exact.
///
/// Rings are closed without their first point again, in either direction. A place is inside of a ring where it is odd
/// times around it. They may touch themselves and each other, in points and along edges, and share points; holes may
/// lie in one another. Repeated points and spikes go. Edges that cross make a Problem (`bad_argument`, with the number
/// of an edge's first point in its ring; the message tells both edges and where): a cut there would need a point
/// that isn't in the input.
/// Other problems: no points (`empty_input`), a point that isn't finite (`not_finite`, its number in its ring), nothing
/// inside (`degenerate`), options outside their limits (`bad_argument`).
///
/// Of a ring of up to 128 corners without holes the parts are as few as can be (Keil and Snoeyink 2002: "On the time
/// bound for convex decomposition of simple polygons"; here O(n^3)). Else a triangulation by a sweep, without the
/// edges that aren't needed (Hertel and Mehlhorn 1983), improved in patches: O(n log n).
///
/// With `conforming`, corners on a straight stretch that several parts share stay corners: no two parts become one
/// where that would leave a third one's corner within the new part's edge. A point in the middle of a straight stretch
/// of the outline that only one part has is no corner of that part, nor of any other.
Result<std::vector<Polygon>> decompose(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes = {},
                                       const OutlineOptions& options = {});

}  // namespace abut
