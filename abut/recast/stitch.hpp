#pragma once

// Stitches polygons that were triangulated separately into one surface. Not for users.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// A polygon, convex in projection along the second axis, with its triangulation and further points on its sides and
/// inside.
struct CutPolygon {
    std::vector<std::uint32_t> corners;  ///< numbers of the surface's corners around the polygon, in either orientation
    std::vector<DVec<3>> points;         ///< the corners first, then the others in any order
    std::vector<glm::uvec3> triangles;   ///< indices into `points`
};

struct Stitched {
    std::vector<DVec<3>> points;
    std::vector<glm::uvec3> triangles;  ///< facing along the second axis
    std::size_t repaired = 0;  ///< polygons whose triangles didn't fill them, and were triangulated from their center
};

struct StitchOptions {
    /// distance from a side within which points of `CutPolygon` lie on it, in projection along the second axis
    double tolerance = 1e-3;
    double step = 0;  ///< corners above one another by at most this are merged
};

/// Stitches polygons without cracks: sides between the same two corners are split at the same points by all their
/// polygons, at the mean of their heights.
Stitched stitch(std::span<const DVec<3>> corners, std::span<const CutPolygon> polygons, const StitchOptions& options);

}  // namespace abut::detail
