#pragma once

// Polygons that were triangulated each by itself become one surface. Not for users.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// A polygon, convex seen along the second axis, cut into triangles with further points on its sides and within.
struct CutPolygon {
    std::vector<std::uint32_t> corners;  ///< of the surface, in the order in which they go round, either way
    std::vector<DVec<3>> points;         ///< first the corners, then the others, in any order
    std::vector<glm::uvec3> triangles;   ///< of `points`
};

struct Stitched {
    std::vector<DVec<3>> points;
    std::vector<glm::uvec3> triangles;  ///< facing along the second axis
    std::size_t mended = 0;  ///< polygons whose triangles didn't fill them, and were cut anew from their middle
};

struct StitchOptions {
    double near = 1e-3;  ///< points of `CutPolygon` within so much of a side lie on it, seen along the second axis
    double step = 0;     ///< corners above one another by at most so much are one
};

/// One surface, without cracks: sides of polygons between the same two corners are cut at the same points, which all of
/// those polygons have there, at the mean of their heights.
Stitched stitch(std::span<const DVec<3>> corners, std::span<const CutPolygon> polygons, const StitchOptions& options);

}  // namespace abut
