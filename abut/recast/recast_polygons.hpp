#pragma once

// The pipeline of Recast, from triangles to polygons. Not for users.

#include <abut/math/function_ref.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/recast/stitch.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// The second axis is up. Lengths in cells: heights and the climbs in cells of height.
struct RecastPlan {
    float cell = 0, cell_height = 0;
    int columns = 0, rows = 0;
    float top = 0;         ///< of the level, which begins at the origin
    int height = 0;        ///< of the walker
    int climb = 0;         ///< between cells next to one another
    int ledge = 0;         ///< cells beside which it goes down by more are no floor; what is on both sides of a slope
    int radius = 0;        ///< of the walker
    int least_region = 0;  ///< in cells
};

struct RecastPolygons {
    std::vector<DVec<3>> corners;
    std::vector<CutPolygon> polygons;
    std::size_t warnings = 0;
};

/// `floor`: which triangles may be walked on. `tell` is told which share is done, and cancels by false.
Result<RecastPolygons> recast_polygons(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                       std::span<const std::uint8_t> floor, const RecastPlan& plan,
                                       FunctionRef<bool(double done)> tell);

}  // namespace abut
