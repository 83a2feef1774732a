#pragma once

// Recast's pipeline from triangles to polygons. Not for users.

#include <abut/math/function_ref.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/recast/stitch.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// The answer after a callback returned false.
inline Problem cancelled() {
    return {ProblemCode::cancelled, "cancelled", 0};
}

/// The second axis is up. Horizontal lengths are in cells, vertical ones in cell heights.
struct RecastPlan {
    float cell = 0, cell_height = 0;
    int columns = 0, rows = 0;
    float top = 0;       ///< of the level, which begins at the origin
    int height = 0;      ///< of the walker
    int climb = 0;       ///< between adjacent cells
    int ledge = 0;       ///< maximum drop beside a floor cell; higher than on both sides of a slope
    int radius = 0;      ///< of the walker
    int min_region = 0;  ///< in cells
};

struct RecastPolygons {
    std::vector<DVec<3>> corners;
    std::vector<CutPolygon> polygons;
    std::size_t warnings = 0;
};

/// `floor` marks the walkable triangles. `report` receives the share of the work that is done; returning false cancels.
Result<RecastPolygons> recast_polygons(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                       std::span<const std::uint8_t> floor, const RecastPlan& plan,
                                       FunctionRef<bool(double done)> report);

}  // namespace abut::detail
