#pragma once

// Hilly terrain as a triangle grid.

#include "../test/oracle/random.hpp"
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::scenes {

struct Terrain {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
};

/// Two triangles per square, row by row. Vertices are row by row too, one more per row.
inline std::vector<glm::uvec3> grid_triangles(std::uint32_t columns, std::uint32_t rows) {
    std::vector<glm::uvec3> result;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t near = row * (columns + 1) + column, far = near + columns + 1;
            result.emplace_back(near, far, near + 1);
            result.emplace_back(near + 1, far, far + 1);
        }
    return result;
}

/// `columns` x `columns` squares of edge 1, centred at the origin, y up, with heights from -0.5 to 0.5.
inline Terrain random_terrain(std::uint32_t columns, oracle::Random& random) {
    Terrain result;
    const float middle = 0.5f * static_cast<float>(columns);
    for (std::uint32_t row = 0; row <= columns; ++row)
        for (std::uint32_t column = 0; column <= columns; ++column)
            result.points.emplace_back(static_cast<float>(column) - middle, random.uniform_float(-0.5, 0.5),
                                       static_cast<float>(row) - middle);
    result.triangles = grid_triangles(columns, columns);
    return result;
}

}  // namespace abut::scenes
