#include "../../scenes/terrain.hpp"
#include "../../test/oracle/random.hpp"
#include "walk.hpp"
#include <abut/math/detail/sin_cos.hpp>

#include <cmath>
#include <utility>

namespace abut::bench {

SharedWalkScene walk_scene(std::uint32_t columns) {
    constexpr std::uint64_t seed = 1;
    oracle::Random random(seed);
    std::vector<Vec3> points;
    for (std::uint32_t row = 0; row <= columns; ++row)
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const double round = 3 * detail::sin_cos(column / 13.0).sin * detail::sin_cos(row / 11.0).cos +
                                 detail::sin_cos(row / 5.0).sin;
            const double height = std::round(256 * (8 + round + random.uniform(-0.1, 0.1))) / 256;
            points.push_back(Vec3(detail::DVec<3>(column, height, row)));
        }
    std::vector<glm::uvec3> triangles = scenes::grid_triangles(columns, columns);
    WalkMesh mesh = *WalkMesh::build(points, triangles);
    return std::make_shared<const WalkScene>(
        WalkScene{columns, std::move(points), std::move(triangles), std::move(mesh)});
}

}  // namespace abut::bench
