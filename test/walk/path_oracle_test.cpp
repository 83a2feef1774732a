// Paths over random ground, compared with shortest paths of other algorithms.

#include "../oracle/is_long.hpp"
#include "../oracle/walk/surface_paths.hpp"
#include "../oracle/walk/visibility_graph.hpp"
#include "../query/hash.hpp"
#include "path_meshes.hpp"
#include <abut/math/pose.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

int times(int count) {
    return oracle::is_long() ? 20 * count : count;
}

/// A grid of squares with holes, of which no two share only a corner.
oracle::Squares random_squares(int size, double missing, oracle::Random& random) {
    oracle::Squares result{size, size, {}};
    for (int i = 0; i < size * size; ++i) result.there.push_back(!random.chance(missing));
    for (bool again = true; again;) {
        again = false;
        for (int y = 1; y < size; ++y)
            for (int x = 1; x < size; ++x) {
                const bool a = result.at(x - 1, y - 1), b = result.at(x, y - 1), c = result.at(x - 1, y),
                           d = result.at(x, y);
                if (a != d || b != c || a == b) continue;
                const int fill_x = a ? x : x - 1, fill_y = y - 1;
                result.there[static_cast<std::size_t>(fill_y * size + fill_x)] = true;
                again = true;
            }
    }
    return result;
}

TEST(path_oracle, flat_ground_with_holes_against_corners_that_see_one_another) {
    int paths = 0, turns = 0, longer = 0, much_longer = 0;
    for (int round = 0; round < times(40); ++round) {
        const std::uint64_t seed = 500 + static_cast<std::uint64_t>(round);
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const int size = 8 + static_cast<int>(random.below(10));
        const double missing = random.uniform(0.05, 0.4);
        const oracle::Squares squares = random_squares(size, missing, random);
        Ground ground = grid(size, size, [&](int x, int y) { return squares.at(x, y); });
        if (ground.triangles.empty()) continue;
        const WalkMesh flat = ground.mesh();
        EXPECT_EQ(flat.report().non_manifold_vertices, 0u);
        // A rotated copy in space.
        const glm::quat rotation = random.rotation<3>();
        for (Vec3& point : ground.points) point = rotate(rotation, point) + Vec3(3, -7, 20);
        const WalkMesh turned = ground.mesh();
        for (int i = 0; i < 12; ++i) {
            const WalkPoint from = random_place(flat, random);
            const WalkPoint to = random_place(flat, random);
            const DVec<2> a(flat.to_world(from)), b(flat.to_world(to));
            const double best = oracle::shortest_path_length(squares, a, b);
            const std::optional<WalkPath> path = flat.find_path(from, to);
            ASSERT_EQ(path.has_value(), best < std::numeric_limits<double>::infinity());
            ASSERT_EQ(turned.find_path(from, to).has_value(), path.has_value());
            if (!path) continue;
            expect_whole(flat, from, to, *path, 1e-5);
            expect_whole(turned, from, to, *turned.find_path(from, to), 5e-5);
            ++paths;
            turns += path->points.size() > 2;
            EXPECT_GE(path->length, best - 1e-5);
            const double over = path->length / std::max(best, 1e-3) - 1;
            longer += over > 1e-3;
            much_longer += over > 0.1;
            // The path turns only at corners of holes.
            for (std::size_t k = 1; k + 1 < path->points.size(); ++k) {
                const Vec3& p = path->points[k];
                EXPECT_TRUE(p.x == std::round(p.x) && p.y == std::round(p.y)) << p.x << ' ' << p.y;
                const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
                EXPECT_EQ(squares.at(x - 1, y - 1) + squares.at(x, y - 1) + squares.at(x - 1, y) + squares.at(x, y), 3);
            }
        }
    }
    EXPECT_GT(turns, paths / 4);
    EXPECT_LE(longer, paths / 20);
    EXPECT_LE(much_longer, paths / 100);
}

/// Hills of several sizes; `rough` is the largest height step between neighbouring corners.
Ground hills(int size, double high, double rough, oracle::Random& random) {
    std::vector<DVec<3>> tops;
    for (int i = 0; i < 6; ++i) {
        const double x = random.uniform(0, size);
        const double y = random.uniform(0, size);
        tops.emplace_back(x, y, random.uniform(-high, high));
    }
    return grid(size, size, everywhere, [&](int x, int y) {
        double sum = random.uniform(-rough, rough);
        for (const DVec<3>& top : tops) {
            const double square = (x - top.x) * (x - top.x) + (y - top.y) * (y - top.y);
            sum += top.z / (1 + 0.05 * square);
        }
        return sum;
    });
}

/// The path turns only at corners of the surface, with an angle of at least pi on either side.
void expect_tight(const Ground& ground, const WalkMesh& mesh, const WalkPath& path) {
    for (std::size_t i = 1; i + 1 < path.points.size(); ++i) {
        const WalkPoint& place = path.places[i];
        for (int k = 0; k < 3; ++k) {
            if (place.weights[k] != 1) continue;
            const DVec<3> before = DVec<3>(path.points[i - 1]) - DVec<3>(path.points[i]);
            const DVec<3> after = DVec<3>(path.points[i + 1]) - DVec<3>(path.points[i]);
            // Short pieces have no direction, as the points are rounded to floats.
            if (length(before) < 0.02 || length(after) < 0.02) continue;
            const auto sides = oracle::angles_beside(ground.points, mesh.triangles(),
                                                     mesh.triangles()[place.triangle][k], before, after);
            EXPECT_GE(sides.first, 3.14159265 - 2e-3) << "point " << i;
            EXPECT_GE(sides.second, 3.14159265 - 2e-3) << "point " << i;
        }
    }
}

TEST(path_oracle, hills_against_lines_between_points_of_edges) {
    int paths = 0, longer = 0, tight = 0;
    for (int round = 0; round < times(12); ++round) {
        const std::uint64_t seed = 700 + static_cast<std::uint64_t>(round);
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const bool is_rough = round % 3 == 2;
        const Ground ground = hills(24, round % 2 == 0 ? 3 : 8, is_rough ? 0.5 : 0.02, random);
        const WalkMesh mesh = ground.mesh();
        const oracle::EdgePointGraph graph(ground.points, ground.triangles, 6);
        for (int i = 0; i < 10; ++i) {
            const WalkPoint from = random_place(mesh, random);
            const WalkPoint to = random_place(mesh, random);
            const DVec<3> a(mesh.to_world(from)), b(mesh.to_world(to));
            const std::optional<WalkPath> path = mesh.find_path(from, to);
            ASSERT_TRUE(path);
            expect_whole(mesh, from, to, *path, 2e-5);
            expect_tight(ground, mesh, *path);
            ++paths;
            tight += path->points.size() > 2;
            EXPECT_GE(path->length, length(b - a) - 1e-5);
            const double over = path->length / graph.min_cost(from.triangle, a, to.triangle, b) - 1;
            longer += over > 1e-3;
            EXPECT_LE(over, is_rough ? 0.03 : 2e-3);
        }
    }
    EXPECT_LE(longer, paths / 10);
    EXPECT_GT(tight, paths / 2);
}

TEST(path_oracle, costs_against_lines_between_points_of_edges) {
    int paths = 0, dearer = 0, much_dearer = 0, detours = 0;
    double sum = 0;
    for (int round = 0; round < times(20); ++round) {
        const std::uint64_t seed = 900 + static_cast<std::uint64_t>(round);
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        Ground ground = hills(16, 3, 0.1, random);
        const std::uint32_t patch = 2 + random.below(5);
        std::vector<std::uint8_t> of_patch;
        for (int i = 0; i < 400; ++i) of_patch.push_back(static_cast<std::uint8_t>(random.below(3)));
        const std::vector<float> costs = {1, random.uniform_float(1.5, 4), 0.5f};
        std::vector<float> of_triangle;
        for (const glm::uvec3& t : ground.triangles) {
            const Vec3 middle = (ground.points[t.x] + ground.points[t.y] + ground.points[t.z]) / 3.0f;
            const std::uint32_t x = static_cast<std::uint32_t>(middle.x) / patch;
            const std::uint32_t y = static_cast<std::uint32_t>(middle.y) / patch;
            ground.areas.push_back(of_patch[20 * y + x]);
            of_triangle.push_back(costs[ground.areas.back()]);
        }
        const WalkMesh mesh = ground.mesh();
        const oracle::EdgePointGraph graph(ground.points, ground.triangles, 6);
        for (int i = 0; i < 10; ++i) {
            const WalkPoint from = random_place(mesh, random);
            const WalkPoint to = random_place(mesh, random);
            const std::optional<WalkPath> path = mesh.find_path(from, to, {.area_costs = costs});
            const std::optional<WalkPath> unweighted = mesh.find_path(from, to);
            ASSERT_TRUE(path && unweighted);
            expect_whole(mesh, from, to, *path, 2e-5);
            EXPECT_GE(path->length, unweighted->length * (1 - 2e-3));
            EXPECT_GE(path->cost, 0.5 * path->length * (1 - 1e-9));
            const double best = graph.min_cost(from.triangle, DVec<3>(mesh.to_world(from)), to.triangle,
                                               DVec<3>(mesh.to_world(to)), of_triangle);
            ++paths;
            detours += path->length > unweighted->length * 1.01;
            const double over = path->cost / best - 1;
            sum += over;
            dearer += over > 0.01;
            much_dearer += over > 0.1;
        }
    }
    EXPECT_GT(detours, paths / 4);
    EXPECT_LE(sum, 0.005 * paths);
    EXPECT_LE(dearer, paths / 8);
    EXPECT_LE(much_dearer, paths / 40);
}

TEST(path_oracle, the_nearest_reachable_place_is_the_nearest) {
    for (int round = 0; round < times(40); ++round) {
        const std::uint64_t seed = 1100 + static_cast<std::uint64_t>(round);
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const oracle::Squares squares = random_squares(10, 0.5, random);
        const Ground ground = grid(10, 10, [&](int x, int y) { return squares.at(x, y); });
        if (ground.triangles.empty()) continue;
        const WalkMesh mesh = ground.mesh();
        const WalkPoint from = random_place(mesh, random);
        const WalkPoint to = random_place(mesh, random);
        const std::optional<WalkPath> path = mesh.find_path(from, to, {.nearest_reachable = true});
        ASSERT_TRUE(path);
        expect_whole(mesh, from, to, *path, 1e-5);
        EXPECT_EQ(path->reached, mesh.component(from.triangle) == mesh.component(to.triangle));
        // The component of the start alone.
        Ground component;
        component.points = ground.points;
        for (std::uint32_t t = 0; t < ground.triangles.size(); ++t)
            if (mesh.component(t) == mesh.component(from.triangle)) component.triangles.push_back(ground.triangles[t]);
        const WalkMesh alone = component.mesh();
        const Vec3 end = mesh.to_world(to);
        EXPECT_NEAR(distance(path->points.back(), end), distance(alone.to_world(alone.nearest(end)), end), 1e-6);
    }
}

TEST(path_oracle, edges_that_may_not_be_crossed_are_not) {
    int paths = 0, longer = 0;
    for (int round = 0; round < times(30); ++round) {
        const std::uint64_t seed = 1300 + static_cast<std::uint64_t>(round);
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const Ground ground = hills(14, 4, 0.1, random);
        const WalkMesh mesh = ground.mesh();
        // Each half-edge is allowed or not by itself.
        std::vector<bool> open;
        for (std::size_t i = 0; i < 3 * ground.triangles.size(); ++i) open.push_back(!random.chance(0.15));
        const auto allow = [&](const WalkSide& from, const WalkSide&) { return open[3 * from.triangle + from.side]; };
        for (int i = 0; i < 10; ++i) {
            const WalkPoint from = random_place(mesh, random);
            const WalkPoint to = random_place(mesh, random);
            const std::optional<WalkPath> path = mesh.find_path(from, to, {.allow = allow});
            // Whole triangles are allowed or not.
            std::vector<bool> reached(ground.triangles.size(), false);
            std::vector<std::uint32_t> now{from.triangle};
            reached[from.triangle] = true;
            while (!now.empty()) {
                const std::uint32_t triangle = now.back();
                now.pop_back();
                for (std::uint32_t side = 0; side < 3; ++side) {
                    const std::optional<WalkSide> beyond = mesh.beyond({triangle, side});
                    if (!beyond || reached[beyond->triangle] || !allow({triangle, side}, *beyond)) continue;
                    reached[beyond->triangle] = true;
                    now.push_back(beyond->triangle);
                }
            }
            ASSERT_EQ(path.has_value(), reached[to.triangle]);
            if (!path) continue;
            expect_whole(mesh, from, to, *path, 2e-5, WalkAllow(allow));
            ++paths;
            longer += path->length > mesh.find_path(from, to)->length * 1.01;
        }
    }
    EXPECT_GT(paths, times(200));
    EXPECT_GT(longer, paths / 20);
}

TEST(path_oracle, scales_and_far_from_the_origin) {
    for (const double scale : {1e-3, 1.0, 1e4}) {
        oracle::Random random(77);
        Ground ground = hills(20, 5, 0.05, random);
        const WalkMesh mesh = ground.mesh();
        for (Vec3& point : ground.points) point *= static_cast<float>(scale);
        const WalkMesh scaled = ground.mesh();
        for (int i = 0; i < 20; ++i) {
            const WalkPoint from = random_place(mesh, random);
            const WalkPoint to = random_place(mesh, random);
            const std::optional<WalkPath> a = mesh.find_path(from, to), b = scaled.find_path(from, to);
            ASSERT_TRUE(a && b);
            EXPECT_NEAR(b->length / scale, a->length, 1e-3 * a->length);
            expect_whole(scaled, from, to, *b, 2e-5 * scale);
        }
    }
}

TEST(path_oracle, the_same_bits_everywhere) {
    // Integer coordinates, so that the answers don't depend on this file's arithmetic.
    oracle::Random random(5);
    std::vector<float> heights;
    for (int i = 0; i < 41 * 41; ++i) heights.push_back(static_cast<float>(random.below(64)));
    Ground ground =
        grid(40, 40, everywhere, [&](int x, int y) { return heights[static_cast<std::size_t>(41 * y + x)]; });
    for (Vec3& point : ground.points) point *= Vec3(32, 32, 1);
    for (std::size_t i = 0; i < ground.triangles.size(); ++i)
        ground.areas.push_back(static_cast<std::uint8_t>(random.below(8) == 0));
    const WalkMesh mesh = ground.mesh();
    const std::vector<float> costs = {1, 2};
    Hash hash;
    for (int i = 0; i < 200; ++i) {
        WalkPoint place[2];
        for (WalkPoint& each : place) {
            each.triangle = random.below(static_cast<std::uint32_t>(ground.triangles.size()));
            const std::uint32_t b = random.below(33);
            const std::uint32_t c = random.below(33);
            each.weights = {static_cast<float>(64 - b - c) / 64, static_cast<float>(b) / 64,
                            static_cast<float>(c) / 64};
        }
        for (const bool dear : {false, true}) {
            WalkPathOptions options;
            if (dear) options.area_costs = costs;
            const std::optional<WalkPath> path = mesh.find_path(place[0], place[1], options);
            ASSERT_TRUE(path);
            for (const Vec3& point : path->points) hash.add<3>(point);
            for (const WalkPoint& each : path->places) hash.add<3>(each.weights);
            hash.add(std::bit_cast<std::uint64_t>(path->cost));
        }
    }
    EXPECT_EQ(hash.value(), 0x06c9af4a7177db36u) << std::hex << hash.value();
}

}  // namespace
}  // namespace abut::test
