// The planes of a hull's faces: no input point is outside of them, and they are moved out only as far as needed.
#include "point_sets.hpp"
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_grid.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/hull_planes.hpp>
#include <abut/convex/hull/quickhull.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

double reach(const Vec3& normal, const std::vector<Vec3>& points) {
    double result = dot(DVec<3>(normal), DVec<3>(points[0]));
    for (const Vec3& point : points) result = std::max(result, dot(DVec<3>(normal), DVec<3>(point)));
    return result;
}

bool along_an_axis(const Vec3& normal) {
    return (normal.x != 0) + (normal.y != 0) + (normal.z != 0) == 1;
}

TEST(HullPlanes, HoldEveryPointAndNoMoreThanTheyMust) {
    int planes = 0, corners_below = 0, pushed_for_those_left_out = 0, exact = 0;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (const double away : {0.0, 1e2, 1e5})
            for (std::uint64_t round = 0; round < 12; ++round) {
                const std::uint64_t seed = 1000 * kind + round;
                SCOPED_TRACE(kinds[kind].name + ", away " + std::to_string(away) + ", seed " + std::to_string(seed));
                Random random(seed);
                std::vector<Vec3> points = kinds[kind].make(random);
                const DVec<3> offset = random.direction<3>() * away;
                for (Vec3& point : points) point = to_float(DVec<3>(point) + offset);
                const Hull3 hull = *abut::detail::hull(points);
                const double extent = abut::detail::extent<3>(points);
                for (std::size_t face = 0; face < hull.normals.size(); ++face) {
                    const double needed = reach(hull.normals[face], points);
                    ASSERT_LE(needed, hull.offsets[face]);
                    ASSERT_LE(hull.offsets[face], needed + 1.6e-7 * extent);
                    if (along_an_axis(hull.normals[face]) || hull.rank == 2) {
                        ASSERT_EQ(hull.offsets[face], needed);
                        ++exact;
                    }
                    pushed_for_those_left_out += hull.offsets[face] > needed + 4e-8 * extent ? 1 : 0;
                    corners_below += needed > reach(hull.normals[face], hull.points) ? 1 : 0;
                    ++planes;
                }
            }
    EXPECT_GT(planes, 10000);
    EXPECT_GT(exact, 100);
    EXPECT_GT(corners_below, 100) << "points that were left out reach farther than the corners";
    EXPECT_GT(pushed_for_those_left_out, 100);
}

// With integers nothing is rounded or omitted: the planes are as near as doubles allow.
TEST(HullPlanes, TouchPointsOfAGridToTheLastBits) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const float scale = static_cast<float>(std::ldexp(1.0, static_cast<int>(random.below(200)) - 100));
        std::vector<Vec3> points = on_a_lattice(random, 30);
        for (Vec3& point : points) point = (point + Vec3(static_cast<float>(random.below(8)) * 0.0625f)) * scale;
        const Hull3 hull = *abut::detail::hull(points);
        const double extent = abut::detail::extent<3>(points);
        for (std::size_t face = 0; face < hull.normals.size(); ++face) {
            const double needed = reach(hull.normals[face], points);
            EXPECT_LE(needed, hull.offsets[face]);
            EXPECT_LE(hull.offsets[face], needed + 5e-14 * extent);
        }
    }
}

// Far from the origin, where the rounding of dot products dominates.
TEST(HullPlanes, HoldPointsOfAGridFarAway) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        std::vector<Vec3> points = on_a_lattice(random, 60);
        const Vec3 away(static_cast<float>(random.below(1u << 20)), static_cast<float>(random.below(1u << 20)), 7);
        for (Vec3& point : points) point += away;
        const Hull3 hull = *abut::detail::hull(points);
        for (std::size_t face = 0; face < hull.normals.size(); ++face) {
            const double needed = reach(hull.normals[face], points);
            ASSERT_LE(needed, hull.offsets[face]);
            ASSERT_LE(hull.offsets[face], needed + 1e-14 * 0x1p20);
        }
    }
}

// For any normals and any start of the search, the planes contain all points and touch the hull.
TEST(HullPlanes, AreFoundFromAnyCorner) {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        SCOPED_TRACE(kinds[kind].name + ", seed " + std::to_string(kind));
        Random random(kind);
        const std::vector<Vec3> points = kinds[kind].make(random);
        if (abut::detail::hull(points)->rank < 3) continue;
        const HullGrid grid = on_grid(points);
        const auto farthest = [&](const DVec<3>& normal) {
            const auto along = [&](std::uint32_t i) {
                return std::abs(dot(normal, DVec<3>(points[i]) - DVec<3>(points[0])));
            };
            std::uint32_t best = 0;
            for (std::uint32_t i = 1; i < points.size(); ++i)
                if (along(i) > along(best)) best = i;
            return best;
        };
        // Four points that span space.
        const auto at = [&](std::uint32_t i) { return DVec<3>(points[i]) - DVec<3>(points[0]); };
        const std::uint32_t a = farthest(random.direction<3>()), b = farthest(perpendicular(at(a)));
        const TriangleSurface surface =
            quickhull(grid.points, {0, a, b, farthest(cross(at(a), at(b)))}, grid.tolerance);
        HullFaces faces;
        for (std::uint32_t i = 0; i < 300; ++i) {
            faces.normals.push_back(to_float(random.direction<3>()));
            faces.loops.push_back(surface.origin[random.below(static_cast<std::uint32_t>(surface.origin.size()))]);
            faces.loop_ends.push_back(i + 1);
        }
        const std::vector<double> offsets = plane_offsets(faces, points, grid, surface);
        ASSERT_EQ(offsets.size(), 300u);
        for (std::size_t i = 0; i < offsets.size(); ++i) {
            const double needed = reach(faces.normals[i], points);
            ASSERT_LE(needed, offsets[i]);
            ASSERT_LE(offsets[i], needed + 1.6e-7 * extent<3>(points));
        }
    }
}

// A cube has its coordinates as offsets, whatever else is in it or on its faces.
TEST(HullPlanes, OfACubeAreItsCoordinates) {
    Random random(91);
    std::vector<Vec3> points = box_surface(1);
    for (int i = 0; i < 200; ++i) {
        Vec3 point = to_float(random.in_cube<3>());
        if (random.chance(0.5)) point[static_cast<int>(random.below(3))] = random.chance(0.5) ? 1.0f : -1.0f;
        points.push_back(point);
    }
    for (Vec3& point : points) point = point * 0.3f + Vec3(0.1f, 7.7f, -1e3f);
    const Hull3 hull = *abut::detail::hull(points);
    ASSERT_EQ(hull.normals.size(), 6u);
    const Vec3 least(-1 * 0.3f + 0.1f, -1 * 0.3f + 7.7f, -1 * 0.3f - 1e3f);
    const Vec3 greatest(0.3f + 0.1f, 0.3f + 7.7f, 0.3f - 1e3f);
    for (std::size_t face = 0; face < 6; ++face) {
        const Vec3& normal = hull.normals[face];
        const int up = normal.x != 0 ? 0 : (normal.y != 0 ? 1 : 2);
        EXPECT_EQ(std::abs(normal[up]), 1);
        EXPECT_EQ(hull.offsets[face], static_cast<double>(normal[up] > 0 ? greatest[up] : -least[up]));
    }
}

TEST(HullGrid, ReturnsHowFarItMovedThePoints) {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        SCOPED_TRACE(kinds[kind].name + ", seed " + std::to_string(kind));
        Random random(kind);
        const std::vector<Vec3> points = kinds[kind].make(random);
        const HullGrid grid = on_grid(points);
        const double extent = abut::detail::extent<3>(points);
        EXPECT_GE(extent / grid.step, 0x1p27);
        EXPECT_LT(extent / grid.step, 0x1p28);
        DVec<3> moved(0.0);
        for (std::size_t i = 0; i < points.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const double back = grid.least[k] + static_cast<double>(grid.points[i][k]) * grid.step;
                moved[k] = std::max(moved[k], std::abs(back - static_cast<double>(points[i][k])) / grid.step);
                EXPECT_LE(grid.least[k], points[i][k]);
                EXPECT_GE(grid.greatest[k], points[i][k]);
            }
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(grid.rounding[k], moved[k], 1e-6);
            EXPECT_LE(grid.rounding[k], 0.5);
        }
    }
}

}  // namespace
}  // namespace abut::test
