#pragma once

// Quickhull in integers: every decision is exact, so the surface is closed and convex by construction.

#include <abut/math/vec.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// A point of the grid. Two points of a set differ by at most 2^28 on every axis.
using GridPoint = glm::vec<3, std::int64_t>;
inline constexpr int grid_bits = 28;

/// The normal of the triangle abc, counter-clockwise seen from its tip, of twice its area. Exact; below 2^58 on every
/// axis.
GridPoint grid_normal(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// dot(normal, difference) with the exact sign, and a relative error of 2^-53, for a normal of `grid_normal` and the
/// difference of two points.
double grid_dot(const GridPoint& normal, const GridPoint& difference);

/// A closed convex surface of triangles in half-edges. Triangle t has the half-edges 3t, 3t + 1 and 3t + 2,
/// counter-clockwise seen from outside. Triangles are in the lexicographical order of their corners, each from its
/// lowest.
struct TriangleSurface {
    std::vector<std::uint32_t> origin;  ///< one per half-edge: the number of its start point
    std::vector<std::uint32_t> twin;    ///< one per half-edge: its twin in the opposite direction
    std::vector<GridPoint> normals;     ///< one per triangle, outwards
    double left_out = 0;                ///< the maximum distance of a point outside of it, in steps of the grid
};

/// The next half-edge of the same triangle.
inline std::uint32_t following(std::uint32_t half_edge) {
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

/// The hull of points with a volume. `start` are four points that aren't coplanar. Points within `tolerance` (in steps
/// of the grid, not below 0) of the surface may be left outside; no other point lies outside. Neighbours may be
/// coplanar, and points in a face or an edge may be corners of triangles.
TriangleSurface quickhull(std::span<const GridPoint> points, const std::array<std::uint32_t, 4>& start,
                          double tolerance);

}  // namespace abut::detail
