// Paths with known answers.

#include "path_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

WalkPath found(const WalkMesh& mesh, const WalkPoint& from, const WalkPoint& to, const WalkPathOptions& options = {}) {
    const std::optional<WalkPath> path = mesh.find_path(from, to, options);
    EXPECT_TRUE(path);
    if (!path) return {};
    expect_whole(mesh, from, to, *path, 1e-5);
    const std::optional<std::vector<Vec3>> points = mesh.path(from, to, options);
    EXPECT_TRUE(points && *points == path->points);
    return *path;
}

TEST(path, is_one_straight_line_on_flat_ground) {
    const WalkMesh mesh = grid(30, 20, everywhere).mesh();
    const WalkPoint from = mesh.nearest({0.3f, 0.4f, 0}), to = mesh.nearest({29.1f, 17.7f, 0});
    const WalkPath path = found(mesh, from, to);
    EXPECT_EQ(path.points.size(), 2u);
    EXPECT_NEAR(path.length, distance(mesh.to_world(from), mesh.to_world(to)), 1e-6);
    EXPECT_EQ(path.cost, path.length);
    EXPECT_TRUE(path.reached);
}

TEST(path, within_a_triangle_and_of_no_length) {
    const WalkMesh mesh = grid(3, 3, everywhere).mesh();
    const WalkPoint from{4, {0.5f, 0.25f, 0.25f}}, to{4, {0.125f, 0.125f, 0.75f}};
    const WalkPath path = found(mesh, from, to);
    EXPECT_EQ(path.points.size(), 2u);
    EXPECT_NEAR(path.length, distance(mesh.to_world(from), mesh.to_world(to)), 1e-7);
    EXPECT_EQ(found(mesh, from, from).length, 0);
    EXPECT_EQ(found(mesh, from, from).points.size(), 2u);
}

TEST(path, of_no_length_between_two_triangles_of_a_corner) {
    const WalkMesh mesh = grid(2, 2, everywhere).mesh();
    for (std::uint32_t a = 0; a < mesh.triangles().size(); ++a)
        for (std::uint32_t b = 0; b < mesh.triangles().size(); ++b)
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) {
                    WalkPoint from{a, Vec3(0.0f)}, to{b, Vec3(0.0f)};
                    from.weights[i] = 1;
                    to.weights[j] = 1;
                    const double apart = distance(mesh.to_world(from), mesh.to_world(to));
                    EXPECT_NEAR(found(mesh, from, to).length, apart, 1e-12);
                }
}

TEST(path, weights_are_shares_of_their_sum) {
    const WalkMesh mesh = grid(5, 5, everywhere).mesh();
    const WalkPoint from{0, {2, 1, 1}}, to{49, {10, 30, 60}};
    EXPECT_NEAR(found(mesh, from, to).length, distance(mesh.to_world(from), mesh.to_world(to)), 1e-6);
}

TEST(path, turns_at_the_corner_of_a_wall_alone) {
    // A wall from the left to x = 6, one square thick.
    const WalkMesh mesh = grid(10, 9, [](int x, int y) { return y != 4 || x >= 6; }).mesh();
    const WalkPath path = found(mesh, mesh.nearest({1, 1, 0}), mesh.nearest({1, 8, 0}));
    ASSERT_EQ(path.points.size(), 4u);
    EXPECT_EQ(path.points[1], Vec3(6, 4, 0));
    EXPECT_EQ(path.points[2], Vec3(6, 5, 0));
    EXPECT_NEAR(path.length, std::sqrt(25.0 + 9) + 1 + std::sqrt(25.0 + 9), 1e-12);
}

TEST(path, from_edges_and_corners_leads_straight_away_to_either_side) {
    const WalkMesh mesh = grid(8, 8, everywhere).mesh();
    for (const Vec3& a : {Vec3(4, 4, 0), Vec3(4.5f, 4, 0), Vec3(4, 4.5f, 0), Vec3(4.5f, 4.5f, 0), Vec3(0, 0, 0)})
        for (int x = 0; x <= 16; ++x)
            for (int y = 0; y <= 16; ++y) {
                const Vec3 b(0.5f * static_cast<float>(x), 0.5f * static_cast<float>(y), 0);
                const WalkPath path = found(mesh, mesh.nearest(a), mesh.nearest(b));
                EXPECT_NEAR(path.length, distance(a, b), 1e-12);
                EXPECT_EQ(path.points.size(), 2u);
            }
}

TEST(path, does_not_lead_through_a_non_manifold_vertex) {
    // Two floors that share only a corner, and a corridor around.
    const auto floors = [](bool corridor) {
        return grid(6, 6, [=](int x, int y) {
            if (x < 3 && y < 3) return true;
            if (x >= 3 && y >= 3) return true;
            return corridor && (y == 0 || x == 5);
        });
    };
    const WalkMesh apart = floors(false).mesh(), joined = floors(true).mesh();
    const Vec3 a(2.5f, 2.5f, 0), b(3.5f, 3.5f, 0);
    EXPECT_FALSE(apart.find_path(apart.nearest(a), apart.nearest(b)));
    EXPECT_FALSE(apart.path(apart.nearest(a), apart.nearest(b)));
    const WalkPath path = found(joined, joined.nearest(a), joined.nearest(b));
    EXPECT_NEAR(path.length,
                std::hypot(0.5, 1.5) + std::hypot(2, 0) + std::hypot(2.0, 2.0) * 0 + 2 + std::hypot(1.5, 0.5), 1e-6);
}

TEST(path, bends_at_edges_that_are_not_flat) {
    // A roof: up 45 degrees and down again.
    const WalkMesh mesh = grid(4, 4, everywhere, [](int x, int) { return 2 - std::abs(x - 2); }).mesh();
    const Vec3 a(0, 1, 0), b(4, 3, 0);
    const WalkPath path = found(mesh, mesh.nearest(a), mesh.nearest(b));
    ASSERT_EQ(path.points.size(), 3u);
    EXPECT_LE(distance(path.points[1], Vec3(2, 2, 2)), 1e-6);
    EXPECT_NEAR(path.length, std::sqrt(32.0 + 4), 1e-12);
}

TEST(path, leads_round_a_peak_on_the_shorter_side) {
    // A pyramid too steep to go over.
    const WalkMesh mesh = grid(8, 8, everywhere, [](int x, int y) { return x == 4 && y == 4 ? 30 : 0; }).mesh();
    const WalkPath low = found(mesh, mesh.nearest({0.5f, 3.9f, 0}), mesh.nearest({7.5f, 3.9f, 0}));
    EXPECT_NEAR(low.length, 2 * std::hypot(2.5, 0.9) + 2, 1e-5);
    const WalkPath high = found(mesh, mesh.nearest({0.5f, 4.1f, 0}), mesh.nearest({7.5f, 4.1f, 0}));
    EXPECT_NEAR(high.length, 2 * std::hypot(2.5, 0.9) + 2, 1e-5);
    for (const Vec3& point : high.points) EXPECT_GE(point.y, 4.0f);
}

TEST(path, leads_round_a_box_as_unfolded) {
    const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const std::vector<glm::uvec3> triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                               {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    const WalkMesh mesh = *WalkMesh::build(points, triangles);
    // Opposite corners of a cube: over one face and half of the next.
    const WalkPath path = found(mesh, mesh.nearest({0, 0, 0}), mesh.nearest({1, 1, 1}));
    EXPECT_NEAR(path.length, std::sqrt(5.0), 1e-12);
    // Middles of opposite faces.
    const WalkPath across = found(mesh, mesh.nearest({0.5f, 0.5f, 0}), mesh.nearest({0.5f, 0.5f, 1}));
    EXPECT_NEAR(across.length, 2, 1e-12);
}

/// A band of `count` squares around a circle of so many sides, with `twists` half turns along it.
Ground band(int count, int half_turns) {
    Ground result;
    const double tau = 6.283185307179586;
    for (int i = 0; i < count; ++i) {
        const double around = tau * i / count, lean = 0.5 * tau * half_turns * i / count;
        for (const double side : {-1.0, 0.0, 1.0}) {
            const double r = 5 + side * std::cos(lean);
            result.points.emplace_back(static_cast<float>(r * std::cos(around)),
                                       static_cast<float>(r * std::sin(around)),
                                       static_cast<float>(side * std::sin(lean)));
        }
    }
    const auto index = [&](int i, int side) {
        if (i == count && half_turns % 2 == 1) side = 2 - side;
        return static_cast<std::uint32_t>(3 * (i % count) + side);
    };
    for (int i = 0; i < count; ++i)
        for (int side = 0; side < 2; ++side) {
            result.triangles.emplace_back(index(i, side), index(i + 1, side), index(i + 1, side + 1));
            result.triangles.emplace_back(index(i, side), index(i + 1, side + 1), index(i, side + 1));
        }
    return result;
}

TEST(path, leads_around_a_moebius_strip_by_the_short_side) {
    const WalkMesh mesh = band(60, 1).mesh();
    ASSERT_GT(mesh.report().mirrored, 0u);
    for (int from = 0; from < 60; from += 7)
        for (int to = 0; to < 60; to += 3) {
            // In the middle of the band, where all pieces have one length.
            const Vec3 a = mesh.points()[static_cast<std::size_t>(3 * from + 1)];
            const Vec3 b = mesh.points()[static_cast<std::size_t>(3 * to + 1)];
            const WalkPath path = found(mesh, mesh.nearest(a), mesh.nearest(b));
            const int steps = std::min(std::abs(from - to), 60 - std::abs(from - to));
            const double along = steps * distance(mesh.points()[1], mesh.points()[4]);
            EXPECT_LE(path.length, along * (1 + 1e-6) + 1e-6) << from << " to " << to;
            EXPECT_GE(path.length, along * 0.7) << from << " to " << to;
        }
}

TEST(path, leads_round_the_back_of_a_ball) {
    Ground ball;
    const int rows = 40, columns = 80;
    const double tau = 6.283185307179586;
    const auto point = [&](int row, int column) {
        if (row == 0 || row == rows) return Vec3(0, 0, row == 0 ? 1 : -1);
        const double down = 0.5 * tau * row / rows, around = tau * column / columns;
        return Vec3(static_cast<float>(std::sin(down) * std::cos(around)),
                    static_cast<float>(std::sin(down) * std::sin(around)), static_cast<float>(std::cos(down)));
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const auto first = static_cast<std::uint32_t>(ball.points.size());
            for (const Vec3& p : {point(row, column % columns), point(row + 1, column % columns),
                                  point(row + 1, (column + 1) % columns), point(row, (column + 1) % columns)})
                ball.points.push_back(p);
            if (row + 1 < rows) ball.triangles.emplace_back(first, first + 1, first + 2);
            if (row > 0) ball.triangles.emplace_back(first, first + 2, first + 3);
        }
    const WalkMesh mesh = ball.mesh();
    ASSERT_EQ(mesh.report().border, 0u);
    oracle::Random random(31);
    for (int i = 0; i < 200; ++i) {
        const WalkPoint from = random_place(mesh, random);
        const WalkPoint to = i % 4 == 0 ? mesh.nearest(-mesh.to_world(from)) : random_place(mesh, random);
        const WalkPath path = found(mesh, from, to);
        const DVec<3> a = normalized(DVec<3>(mesh.to_world(from))), b = normalized(DVec<3>(mesh.to_world(to)));
        const double arc = std::atan2(length(cross(a, b)), dot(a, b));
        EXPECT_NEAR(path.length, arc, 0.004 * arc + 1e-4);
    }
}

TEST(path, keeps_to_doors_that_may_be_crossed) {
    // Two floors, a door of one square in the wall between them, and a long detour.
    const WalkMesh mesh = grid(9, 9, [](int x, int y) { return x != 4 || y == 4 || y == 0; }).mesh();
    const WalkPoint from = mesh.nearest({1.5f, 4.5f, 0}), to = mesh.nearest({7.5f, 4.5f, 0});
    EXPECT_NEAR(found(mesh, from, to).length, 6, 1e-6);
    // The door is closed in the direction +x.
    const auto closed = [&](const WalkSide& side, const WalkSide& next) {
        const auto middle = [&](std::uint32_t triangle) {
            return mesh.to_world({triangle, {1.0f / 3, 1.0f / 3, 1.0f / 3}});
        };
        const Vec3 a = middle(side.triangle), b = middle(next.triangle);
        return !(a.x < 4 && b.x > 4 && a.y > 4);
    };
    WalkPathOptions options;
    options.allow = closed;
    const WalkPath round = found(mesh, from, to, options);
    EXPECT_NEAR(round.length, 2 * std::hypot(2.5, 3.5) + 1, 1e-6);
    EXPECT_NEAR(found(mesh, to, from, options).length, 6, 1e-6);
}

TEST(path, unreachable_ends_are_reported_and_the_nearest_place_found) {
    const WalkMesh mesh = grid(9, 5, [](int x, int) { return x != 5; }).mesh();
    const WalkPoint from = mesh.nearest({0.5f, 2.5f, 0}), to = mesh.nearest({8.25f, 1.75f, 0});
    EXPECT_FALSE(mesh.find_path(from, to));
    WalkPathOptions options;
    options.nearest_reachable = true;
    const WalkPath path = found(mesh, from, to, options);
    EXPECT_FALSE(path.reached);
    EXPECT_LE(distance(path.points.back(), Vec3(5, 1.75f, 0)), 1e-6);
    EXPECT_NEAR(path.length, std::hypot(4.5, 0.75), 1e-6);
    // A reachable goal is reached.
    EXPECT_TRUE(found(mesh, from, mesh.nearest({3, 3, 0}), options).reached);
    // In one component, but closed.
    const WalkMesh whole = grid(9, 5, everywhere).mesh();
    const auto never = [](const WalkSide&, const WalkSide&) { return false; };
    options.allow = never;
    const WalkPoint start = whole.nearest({0.5f, 2.25f, 0});
    const WalkPath stuck = found(whole, start, whole.nearest({8.25f, 1.75f, 0}), options);
    EXPECT_FALSE(stuck.reached);
    EXPECT_EQ(stuck.places.back().triangle, start.triangle);
}

TEST(path, goes_round_mud_and_along_a_road) {
    Ground ground = grid(20, 20, everywhere);
    for (const glm::uvec3& t : ground.triangles) {
        const Vec3 middle = (ground.points[t.x] + ground.points[t.y] + ground.points[t.z]) / 3.0f;
        const bool mud = middle.x > 8 && middle.x < 12 && middle.y > 4 && middle.y < 16;
        const bool road = middle.y < 1;
        ground.areas.push_back(mud ? 1 : road ? 2 : 0);
    }
    const WalkMesh mesh = ground.mesh();
    const WalkPoint from = mesh.nearest({1, 10, 0}), to = mesh.nearest({19, 10, 0});
    EXPECT_NEAR(found(mesh, from, to).length, 18, 1e-6);

    const std::vector<float> dear = {1, 100};
    const WalkPath round = found(mesh, from, to, {.area_costs = dear});
    EXPECT_NEAR(round.length, 2 * std::hypot(7, 6) + 4, 1e-6);
    EXPECT_NEAR(round.cost, round.length, 1e-9);

    // Through the mud, if it is cheap: 14 outside and 4 within.
    const std::vector<float> wet = {1, 1.25f};
    const WalkPath through = found(mesh, from, to, {.area_costs = wet});
    EXPECT_NEAR(through.length, 18, 1e-6);
    EXPECT_NEAR(through.cost, 14 + 4 * 1.25, 1e-6);

    // Along the edge y = 1 of the road, entered and left at an angle whose sine is the ratio of the costs.
    const std::vector<float> cheap_road = {1, 1, 0.125f};
    const WalkPath ride = found(mesh, mesh.nearest({1, 2, 0}), mesh.nearest({19, 2, 0}), {.area_costs = cheap_road});
    const double slope = 0.125 / std::sqrt(1 - 0.125 * 0.125);
    const double best = 2 * std::sqrt(1 + slope * slope) + (18 - 2 * slope) * 0.125;
    EXPECT_NEAR(ride.cost, best, 1e-3 * best);

    // Closed.
    const std::vector<float> closed = {1, infinite};
    EXPECT_NEAR(found(mesh, from, to, {.area_costs = closed}).length, 2 * std::hypot(7, 6) + 4, 1e-6);
    EXPECT_FALSE(mesh.find_path(from, mesh.nearest({10, 10, 0}), {.area_costs = closed}));
    EXPECT_FALSE(mesh.find_path(mesh.nearest({10, 10, 0}), to, {.area_costs = closed}));
    const WalkPath edge =
        found(mesh, from, mesh.nearest({9, 10.5f, 0}), {.area_costs = closed, .nearest_reachable = true});
    EXPECT_FALSE(edge.reached);
    EXPECT_LE(distance(edge.points.back(), Vec3(8, 10.5f, 0)), 1e-6);
}

TEST(path, is_refracted_where_the_cost_changes) {
    Ground ground = grid(20, 20, everywhere);
    for (const glm::uvec3& t : ground.triangles)
        ground.areas.push_back((ground.points[t.x].x + ground.points[t.y].x + ground.points[t.z].x) / 3 > 10 ? 1 : 0);
    const WalkMesh mesh = ground.mesh();
    const std::vector<float> costs = {1, 3};
    const Vec3 a(2.25f, 3.25f, 0), b(16.5f, 17.75f, 0);
    const WalkPath path = found(mesh, mesh.nearest(a), mesh.nearest(b), {.area_costs = costs});
    double best = 1e9;
    for (int i = 0; i <= 2000000; ++i) {
        const Vec3 at(10, 20.0f * static_cast<float>(i) / 2000000, 0);
        best = std::min(best, distance(a, at) + 3 * distance(at, b));
    }
    EXPECT_NEAR(path.cost, best, 1e-6);
    ASSERT_EQ(path.points.size(), 3u);
    EXPECT_NEAR(path.points[1].x, 10, 1e-6);
}

TEST(path, may_be_one_sided_floors_and_ceilings) {
    // The mesh upside down.
    Ground ground = grid(12, 12, [](int x, int y) { return x != 6 || y > 9; });
    const WalkMesh floor = ground.mesh();
    for (glm::uvec3& t : ground.triangles) std::swap(t.y, t.z);
    const WalkMesh ceiling = ground.mesh();
    const Vec3 a(1, 1, 0), b(11, 1, 0);
    EXPECT_EQ(found(floor, floor.nearest(a), floor.nearest(b)).points,
              found(ceiling, ceiling.nearest(a), ceiling.nearest(b)).points);
}

}  // namespace
}  // namespace abut::test
