#pragma once

// Convex hulls of point sets: the engines behind Polygon and Polyhedron.
// The input is floats, sorted before anything else, so that a hull doesn't depend on the order its points came in.

#include <abut/convex/facets.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Points within this times the extent (the longest side of the bounding box) of the hull of the others may be left
/// out, and sets no thicker than this are flat: the rounding of a float as large as the extent.
inline constexpr double hull_tolerance = 0x1p-23;

/// Neighbouring faces whose corners lie in a slab this thick, times the extent, become one.
inline constexpr double hull_flatness = 0x1p-20;

/// The hull of points of a plane. Points on an edge are no corners.
struct Hull2 {
    std::vector<Vec2> points;  ///< the corners, counter-clockwise from the lexicographically least; one or two if flat
    int rank = 0;              ///< 0: a point, 1: a segment, 2: an area
};

/// The hull of points of space, with its faces as loops like those of `Facets`: counter-clockwise seen from outside,
/// each from its lowest point number, in lexicographical order.
struct Hull3 {
    std::vector<Vec3> points;              ///< the corners, in lexicographical order
    std::vector<Vec3> normals;             ///< one a face, of length 1, outwards
    std::vector<double> offsets;           ///< one a face: dot(normal, p) <= offset, in double, for every input point
    std::vector<std::uint32_t> loops;      ///< the point numbers of all faces, one after the other
    std::vector<std::uint32_t> loop_ends;  ///< one a face: where its loop ends in `loops`
    std::vector<FacetEdge> edges;          ///< as those of `Facets`
    double volume = 0;                     ///< of a solid
    double area = 0;                       ///< of all faces
    Vec3 centroid{};                       ///< of the volume; of the polygon, segment or point where there is none
    int rank = 0;  ///< 0: a point, 1: a segment, both without faces, 2: a flat polygon of two faces, 3: a solid
};

/// The corners of the hull as indices, by the monotone chain of Andrew (1979): counter-clockwise, from the
/// lexicographically least, no three on a line, exactly. One index where all points are the same, two where they lie on
/// a line. The points are finite; there is at least one.
std::vector<std::uint32_t> hull_loop(std::span<const Vec2> points);

/// The hull of every non-empty set of finite points; a Problem names the first point that isn't finite.
Result<Hull2> hull(std::span<const Vec2> points);

/// The same in space: a quickhull (Barber, Dobkin, Huhdanpaa 1996) in whole numbers. Most points deep inside are
/// dropped, which changes nothing (see hull_core.hpp); the others are rounded to a grid of 2^27 to 2^28 steps along the
/// extent, finer than the rounding of the floats, and from there every decision is exact: the surface is closed and
/// convex whatever comes in. Corners are points of the input, bit by bit (-0 becomes 0).
Result<Hull3> hull(std::span<const Vec3> points);

}  // namespace abut
