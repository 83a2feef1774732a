// Dropping points deep inside changes no hull: no dropped point matters, and many are dropped.
#include "point_sets.hpp"
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_grid.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/interior_filter.hpp>

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

std::vector<Vec3> in_a_ball(Random& random, int count) {
    std::vector<Vec3> result;
    while (result.size() < static_cast<std::size_t>(count)) {
        const DVec<3> point = random.in_cube<3>();
        if (dot(point, point) <= 1) result.push_back(to_float(point));
    }
    return result;
}

/// Few points are far out, the worst case of a map of directions.
std::vector<Vec3> in_a_star(Random& random, int count) {
    std::vector<Vec3> result = in_a_ball(random, count);
    for (Vec3& point : result)
        if (random.chance(0.001)) point = to_float(random.direction<3>() * random.uniform(2, 20));
    return result;
}

const std::vector<Kind> clouds{
    {"ball", [](Random& random) { return in_a_ball(random, 4000); }},
    {"cube", [](Random& random) { return in_a_cube(random, 4000); }},
    {"star", [](Random& random) { return in_a_star(random, 4000); }},
    {"sphere", [](Random& random) { return on_a_sphere(random, 3000); }},
    {"tetrahedron",
     [](Random& random) {
         std::vector<Vec3> points = in_a_cube(random, 12000);
         std::erase_if(points, [](const Vec3& p) {
             return p.x < -0.9f || p.y < -0.9f || p.z < -0.9f || p.x + p.y + p.z > -0.5f;
         });
         while (points.size() < 2500) points.push_back(points[random.below(100)] * 0.5f);
         return points;
     }},
    {"plate, turned",
     [](Random& random) {
         const std::vector<Vec3> points = in_a_ball(random, 4000);
         const float z = thin(random);
         return turned(stretched(points, {1, 1, z}), random);
     }},
    {"plate",
     [](Random& random) {
         return stretched(in_a_ball(random, 4000), {1, 1, 1e-3f});
     }},
    {"needle, turned",
     [](Random& random) {
         const std::vector<Vec3> points = in_a_ball(random, 4000);
         const float xy = thin(random);
         return turned(stretched(points, {xy, xy, 1}), random);
     }},
    // If many corners are in few cells of the map, only the farthest of each cell stays.
    {"flint",
     [](Random& random) {
         std::vector<Vec3> points = on_a_sphere(random, 2500);
         for (Vec3& point : points)
             if (random.chance(0.9)) point *= static_cast<float>(random.uniform(0.9, 1));
         const float y = random.uniform_float(0.02, 0.5), z = random.uniform_float(0.02, 0.5);
         return turned(stretched(points, {1, y, z}), random);
     }},
    {"lattice",
     [](Random& random) {
         std::vector<Vec3> points;
         for (int i = 0; i < 4000; ++i) {
             const float x = static_cast<float>(random.below(16)), y = static_cast<float>(random.below(16));
             points.emplace_back(x, y, static_cast<float>(random.below(16)));
         }
         return points;
     }},
};

/// Offsets and sizes of the clouds.
std::vector<Vec3> placed(std::vector<Vec3> points, Random& random) {
    const DVec<3> offset = random.direction<3>() * (random.chance(0.5) ? 0 : random.power_of_two(0, 12));
    const double scale = random.power_of_two(-20, 20);
    for (Vec3& point : points) point = to_float((DVec<3>(point) + offset) * scale);
    return points;
}

std::vector<Vec3> sorted(std::vector<Vec3> points) {
    std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return less<3>(a, b); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

// The surface of the remaining points, in integers on the grid of all points: every dropped point is exactly below all
// its triangles.
TEST(HullCore, IsInsideOfTheRestExactly) {
    std::size_t dropped = 0, all = 0;
    for (std::size_t kind = 0; kind < clouds.size(); ++kind)
        for (std::uint64_t round = 0; round < 4; ++round) {
            const std::uint64_t seed = 100 * kind + round;
            SCOPED_TRACE(clouds[kind].name + ", seed " + std::to_string(seed));
            Random random(seed);
            const std::vector<Vec3> points = sorted(placed(clouds[kind].make(random), random));
            const std::vector<Vec3> rest = sorted(without_interior_points(points));
            ASSERT_TRUE(std::includes(points.begin(), points.end(), rest.begin(), rest.end(),
                                      [](const Vec3& a, const Vec3& b) { return less<3>(a, b); }));
            all += points.size();
            dropped += points.size() - rest.size();
            const HullGrid grid = on_grid(points), rest_grid = on_grid(rest);
            ASSERT_EQ(grid.least, rest_grid.least);
            ASSERT_EQ(grid.greatest, rest_grid.greatest);
            const Spread spread = spread_of(rest_grid, rest_grid.tolerance);
            ASSERT_EQ(spread.rank, spread_of(grid, grid.tolerance).rank);
            if (spread.rank < 3) continue;
            const TriangleSurface surface = quickhull(rest_grid.points, spread.points, 0);
            for (std::size_t t = 0; t < surface.normals.size(); ++t) {
                const GridPoint& corner = rest_grid.points[surface.origin[3 * t]];
                for (const GridPoint& point : grid.points) ASSERT_LE(grid_dot(surface.normals[t], point - corner), 0);
            }
        }
    EXPECT_GT(dropped, all / 4);
    EXPECT_LT(dropped, all * 3 / 4);
}

TEST(HullCore, DoesNotDependOnTheOrder) {
    for (std::size_t kind = 0; kind < clouds.size(); ++kind) {
        SCOPED_TRACE(clouds[kind].name + ", seed " + std::to_string(kind));
        Random random(kind);
        std::vector<Vec3> points = clouds[kind].make(random);
        const std::vector<Vec3> once = sorted(without_interior_points(points));
        for (std::size_t i = points.size(); i > 1; --i)
            std::swap(points[i - 1], points[random.below(static_cast<std::uint32_t>(i))]);
        EXPECT_EQ(sorted(without_interior_points(points)), once);
    }
}

TEST(HullCore, IsMostOfABall) {
    Random random(5);
    EXPECT_LT(without_interior_points(in_a_ball(random, 100000)).size(), 10000u);
}

TEST(HullCore, IsLeftAloneWhereFloatsMightOverflow) {
    Random random(6);
    const std::vector<Vec3> ball = in_a_ball(random, 3000);
    for (const float scale : {1e38f, 1e-38f}) {
        std::vector<Vec3> points = stretched(ball, Vec3(scale));
        EXPECT_EQ(without_interior_points(points), points);
        EXPECT_EQ(abut::detail::hull(points)->rank, 3);
    }
}

}  // namespace
}  // namespace abut::test
