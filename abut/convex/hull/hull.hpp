#pragma once

// Convex hulls of point sets, for Polygon and Polyhedron.
// The input points are sorted first, so that a hull doesn't depend on their order.

#include <abut/convex/facets.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// The relative tolerance of a hull: the rounding of a float as large as the extent (the longest side of the bounding
/// box). Points no farther than this from the hull of the others may be left out, and thinner sets are flat.
inline constexpr double hull_tolerance = 0x1p-23;

/// Neighbouring faces are merged if their corners lie in a slab of this thickness, times the extent.
inline constexpr double hull_flatness = 0x1p-20;

/// The hull of points in 2D. Points on an edge are no corners.
struct Hull2 {
    std::vector<Vec2> points;  ///< the corners, counter-clockwise from the lexicographically least; one or two if flat
    int rank = 0;              ///< 0: a point, 1: a segment, 2: an area
};

/// The hull of points in 3D. Its faces are loops like those of `Facets`: counter-clockwise seen from outside, each from
/// its lowest point number, in lexicographical order.
struct Hull3 {
    std::vector<Vec3> points;              ///< the corners, in lexicographical order
    std::vector<Vec3> normals;             ///< one per face, of length 1, outwards
    std::vector<double> offsets;           ///< one per face: dot(normal, p) <= offset, in double, for every input point
    std::vector<std::uint32_t> loops;      ///< the point numbers of all faces, one after the other
    std::vector<std::uint32_t> loop_ends;  ///< one per face: the end of its loop in `loops`
    std::vector<FacetEdge> edges;          ///< as those of `Facets`
    double volume = 0;                     ///< of a solid
    double area = 0;                       ///< of all faces
    Vec3 centroid{};                       ///< of the volume; of the polygon, segment or point where there is none
    int rank = 0;  ///< 0: a point, 1: a segment, both without faces, 2: a flat polygon of two faces, 3: a solid
};

/// The corners of the hull as indices, by the monotone chain of Andrew (1979) with exact predicates: counter-clockwise,
/// from the lexicographically least, no three collinear. One index if all points are equal, two if they are collinear.
/// The points are finite; there is at least one.
std::vector<std::uint32_t> hull_loop(std::span<const Vec2> points);

/// The hull of any non-empty set of finite points. Otherwise a Problem names the first point that isn't finite.
Result<Hull2> hull(std::span<const Vec2> points);

/// The hull in 3D by quickhull (Barber, Dobkin, Huhdanpaa 1996) in integers. Most interior points are removed first,
/// which doesn't change the hull (see interior_filter.hpp). The others are rounded to a grid of 2^27 to 2^28 steps
/// along the extent, finer than the rounding of the floats. From there every decision is exact: the surface is closed
/// and convex for any input. Corners are input points, bit by bit (-0 becomes 0).
Result<Hull3> hull(std::span<const Vec3> points);

}  // namespace abut::detail
