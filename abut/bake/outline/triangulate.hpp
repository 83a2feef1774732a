#pragma once

// Triangulates an outline with holes by a plane sweep, the first step of its decomposition.

#include <abut/math/detail/no_index.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace abut::outline {

/// A triangulation in half-edges: those of triangle t are 3 t, 3 t + 1 and 3 t + 2, counter-clockwise.
struct Triangulation {
    std::vector<Vec2> points;            ///< in lexicographical order, each once
    std::vector<std::uint32_t> origins;  ///< one per half-edge: the point that it starts from
    std::vector<std::uint32_t> twins;    ///< one per half-edge: the opposite half-edge; `none` at the boundary

    std::size_t repeated_points = 0;  ///< at the position of the previous point
    std::size_t touching_points = 0;  ///< repeated visits of the boundary to a point
    std::size_t cancelled_edges = 0;  ///< edges that the boundary traverses in both directions
    std::size_t idle_holes = 0;       ///< holes that remove nothing
};

/// Triangulates the points that are in the outline and in no hole, by the even-odd rule for each ring. The corners are
/// points of the rings; no triangle is degenerate, and no point lies within an edge.
///
/// This is the plane sweep of de Berg et al. ("Computational Geometry", chapter 3), extended to edges that touch in
/// every way: an edge with a point on it is split there, and coincident edges are merged. All orientation tests are
/// exact. O(n log n). A Problem if a point isn't finite (its number in its ring) or two edges cross (the number of the
/// first one's first point); the message names the ring.
Result<Triangulation> triangulate(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes);

/// Flips edges to the shorter diagonal of their quadrilateral, if it is convex, until no edge can be shortened. This
/// replaces the thin triangles of the sweep.
void shorten_edges(Triangulation& triangles);

}  // namespace abut::outline
