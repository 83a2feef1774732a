// The surface of quickhull is closed and convex, decided in integers, and contains every point: exactly, if the
// tolerance is zero.
#include "point_sets.hpp"
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_grid.hpp>
#include <abut/convex/hull/hull_input.hpp>

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

double height_above(const HullGrid& grid, const TriangleSurface& surface, std::size_t triangle,
                    const GridPoint& point) {
    return grid_dot(surface.normals[triangle], point - grid.points[surface.origin[3 * triangle]]);
}

void expect_closed_and_convex(const HullGrid& grid, const TriangleSurface& surface) {
    ASSERT_EQ(surface.origin.size(), 3 * surface.normals.size());
    ASSERT_EQ(surface.twin.size(), surface.origin.size());
    for (std::uint32_t h = 0; h < surface.origin.size(); ++h) {
        const std::uint32_t twin = surface.twin[h];
        ASSERT_EQ(surface.twin[twin], h);
        ASSERT_EQ(surface.origin[twin], surface.origin[following(h)]);
        const std::uint32_t apex = surface.origin[following(following(twin))];
        ASSERT_LE(height_above(grid, surface, h / 3, grid.points[apex]), 0) << "not convex";
    }
    for (std::size_t t = 0; t < surface.normals.size(); ++t)
        ASSERT_EQ(surface.normals[t],
                  grid_normal(grid.points[surface.origin[3 * t]], grid.points[surface.origin[3 * t + 1]],
                              grid.points[surface.origin[3 * t + 2]]));
}

// The triangles come sorted, each from its lowest corner, so that equal surfaces compare equal.
void expect_in_order(const TriangleSurface& surface) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t h = 0; h < surface.origin.size(); h += 3)
        triangles.push_back({surface.origin[h], surface.origin[h + 1], surface.origin[h + 2]});
    EXPECT_TRUE(std::is_sorted(triangles.begin(), triangles.end()));
    for (const auto& triangle : triangles) EXPECT_EQ(*std::min_element(triangle.begin(), triangle.end()), triangle[0]);
}

TEST(Quickhull, HoldsEveryPointExactlyWhereNothingMayBeLeftOut) {
    std::size_t triangles = 0, coplanar = 0;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (std::uint64_t round = 0; round < 10; ++round) {
            const std::uint64_t seed = 1000 * kind + round;
            SCOPED_TRACE(kinds[kind].name + ", seed " + std::to_string(seed));
            Random random(seed);
            const std::vector<Vec3> points = kinds[kind].make(random);
            const HullGrid grid = on_grid(points);
            const Spread spread = spread_of(grid, grid.tolerance);
            if (spread.rank < 3) continue;
            const TriangleSurface surface = quickhull(grid.points, spread.points, 0);
            expect_closed_and_convex(grid, surface);
            expect_in_order(surface);
            EXPECT_EQ(surface.left_out, 0);
            triangles += surface.normals.size();
            for (std::size_t t = 0; t < surface.normals.size(); ++t)
                for (const GridPoint& point : grid.points) {
                    const double height = height_above(grid, surface, t, point);
                    ASSERT_LE(height, 0) << "a point outside";
                    coplanar += height == 0 ? 1 : 0;
                }
        }
    EXPECT_GT(triangles, 10000u);
    EXPECT_GT(coplanar, 3 * triangles + 500) << "three are corners of its own";
}

TEST(Quickhull, BoundsTheDistanceOfOmittedPoints) {
    std::size_t outside = 0;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (std::uint64_t round = 0; round < 10; ++round) {
            const std::uint64_t seed = 1000 * kind + round;
            SCOPED_TRACE(kinds[kind].name + ", seed " + std::to_string(seed));
            Random random(seed);
            const std::vector<Vec3> points = kinds[kind].make(random);
            const HullGrid grid = on_grid(points);
            const double tolerance = 100 * grid.tolerance;
            const Spread spread = spread_of(grid, tolerance);
            if (spread.rank < 3) continue;
            const TriangleSurface surface = quickhull(grid.points, spread.points, tolerance);
            expect_closed_and_convex(grid, surface);
            EXPECT_LE(surface.left_out, tolerance * (1 + 1e-9));
            for (std::size_t t = 0; t < surface.normals.size(); ++t)
                for (const GridPoint& point : grid.points) {
                    const double height = height_above(grid, surface, t, point) / length(DVec<3>(surface.normals[t]));
                    ASSERT_LE(height, surface.left_out + 0x1p-20);
                    outside += height > 0 ? 1 : 0;
                }
        }
    EXPECT_GT(outside, 1000u);
}

// The tip of a cone over a ring is a corner of as many triangles as the ring has; it is found early or late.
TEST(Quickhull, OfACone) {
    for (const float tip : {0.01f, 1.0f, 100.0f}) {
        std::vector<Vec3> points = rings(500);
        for (Vec3& point : points) point.z = 0;
        points.push_back({0, 0, tip});
        const Hull3 hull = *abut::detail::hull(points);
        EXPECT_EQ(hull.points.size(), 501u);
        EXPECT_EQ(hull.rank, 3);
        for (std::size_t face = 0; face < hull.normals.size(); ++face)
            for (const Vec3& point : points)
                ASSERT_LE(dot(DVec<3>(hull.normals[face]), DVec<3>(point)), hull.offsets[face]);
    }
}

}  // namespace
}  // namespace abut::test
