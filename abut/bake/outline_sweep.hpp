#pragma once

// From rings of points to triangles between them: the first step of the decomposition of outlines.

#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace abut::outline {

inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Triangles that share their corners, as half-edges: those of triangle t are 3 t, 3 t + 1 and 3 t + 2, around it
/// counter-clockwise.
struct Triangulation {
    std::vector<Vec2> points;            ///< in lexicographical order, each once
    std::vector<std::uint32_t> origins;  ///< one a half-edge: the point that it starts from
    std::vector<std::uint32_t> twins;    ///< one a half-edge: the other way along the same line; `none`: the boundary

    std::size_t repeated_points = 0;  ///< at the position of the point before
    std::size_t touching_points = 0;  ///< where the boundary comes by again
    std::size_t cancelled_edges = 0;  ///< along which the boundary goes there and back
    std::size_t idle_holes = 0;       ///< which take nothing away
};

/// What lies in the outline (an odd number of times around) and in no hole (likewise each), in triangles between the
/// points of the rings. No triangle is flat, no point lies on an edge between two others. The sweep along x of de Berg
/// et al. ("Computational Geometry", chapter 3), of edges that may touch in every way: one that a point lies on is two
/// from there on, and those that run along each other are one. All by exact turns: O(n log n).
/// A Problem where a point isn't finite (its number in its ring) or two edges cross (the number of the first's first
/// point); which ring, the message tells.
Result<Triangulation> triangulate(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes);

}  // namespace abut::outline
