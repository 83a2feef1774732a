// Walk meshes of levels: where a walker fits and climbs, and that the surface has no cracks.

#include "../../scenes/terrain.hpp"
#include "../oracle/random.hpp"
#include "level.hpp"
#include <abut/shape/mesh.hpp>

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using namespace recast_test;
using oracle::Random;

constexpr float nan_float = std::numeric_limits<float>::quiet_NaN();

ProblemCode code_of(const Result<WalkMesh>& result) {
    EXPECT_FALSE(result);
    if (result) return ProblemCode::not_found;
    EXPECT_FALSE(result.problem().message.empty());
    return result.problem().code;
}

/// Expects that building the mesh changed nothing.
void expect_clean(const WalkMesh& mesh, const WalkMeshBakeReport& report) {
    EXPECT_FALSE(changed(mesh.report())) << described(mesh.report());
    EXPECT_EQ(mesh.report().mirrored, 0u);
    EXPECT_EQ(cracks_of(mesh, 0.2 * static_cast<double>(report.cell)), 0u);
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i)
        ASSERT_GT(mesh.normal({i, {1, 0, 0}}).y, 0.0f) << "triangle " << i;
}

Level room_with_table() {
    Level level;
    level.floor(0, 0, 10, 10);
    level.box({4, 0, 4}, {6, 0.8f, 6});
    return level;
}

/// Two rooms, and a wall between them with a door of this width and height.
Level two_rooms(float width, float height) {
    Level level;
    level.floor(0, 0, 10, 6);
    level.box({4.8f, 0, 0}, {5.2f, 4, 3 - 0.5f * width});
    level.box({4.8f, 0, 3 + 0.5f * width}, {5.2f, 4, 6});
    level.box({4.8f, height, 0}, {5.2f, 4, 6});
    return level;
}

Level terrain(std::uint32_t columns, float steep, Random& random) {
    scenes::Terrain ground = scenes::random_terrain(columns, random);
    for (Vec3& point : ground.points) point.y *= steep;
    return {std::move(ground.points), std::move(ground.triangles)};
}

TEST(BakeWalkMesh, KeepsAwayFromATable) {
    const Level level = room_with_table();
    WalkMeshBakeReport report;
    const Result<WalkMesh> mesh = level.bake({.report = &report});
    ASSERT_TRUE(mesh) << mesh.problem().message;
    expect_clean(*mesh, report);
    EXPECT_EQ(mesh->report().components, 2u);
    EXPECT_TRUE(is_floor(*mesh, {1, 0, 1}));
    EXPECT_TRUE(is_floor(*mesh, {5, 0.8f, 5}));
    EXPECT_FALSE(joined(*mesh, {1, 0, 1}, {5, 0.8f, 5}));
    EXPECT_TRUE(is_floor(*mesh, {5, 0, 3.3f}));
    EXPECT_FALSE(is_floor(*mesh, {5, 0, 3.75f}));
    // The floor and the table's top, less the walker's radius, and up to two cells at ledges and walls.
    const auto square = [](double side) { return side * side; };
    const double cell = report.cell;
    EXPECT_LT(area_of(*mesh), square(10 - 0.8) - square(2 + 0.8 - 2 * cell) + square(2 - 0.8 + 2 * cell));
    EXPECT_GT(area_of(*mesh), square(10 - 0.8 - 4 * cell) - square(2 + 0.8 + 4 * cell));

    const Result<WalkMesh> reached = level.bake({.starts = std::vector<Vec3>{{1, 0, 1}}, .report = &report});
    ASSERT_TRUE(reached) << reached.problem().message;
    EXPECT_EQ(reached->report().components, 1u);
    EXPECT_EQ(report.left_out, 1u);
    EXPECT_TRUE(is_floor(*reached, {1, 0, 1}));
    EXPECT_FALSE(is_floor(*reached, {5, 0.8f, 5}));

    const Result<WalkMesh> large = level.bake({.min_area = 3});
    ASSERT_TRUE(large) << large.problem().message;
    EXPECT_EQ(large->report().components, 1u);
    EXPECT_FALSE(is_floor(*large, {5, 0.8f, 5}));
}

TEST(BakeWalkMesh, ClimbsSteps) {
    for (const float height : {0.1f, 0.25f, 0.3f, 0.4f, 0.6f}) {
        SCOPED_TRACE(height);
        Level level;
        level.floor(-5, -2, 0, 2);
        level.box({0, -1, -2}, {5, height, 2});
        WalkMeshBakeReport report;
        const Result<WalkMesh> mesh = level.bake({.report = &report});
        ASSERT_TRUE(mesh) << mesh.problem().message;
        expect_clean(*mesh, report);
        EXPECT_TRUE(is_floor(*mesh, {-3, 0, 0}));
        EXPECT_TRUE(is_floor(*mesh, {3, height, 0}));
        EXPECT_EQ(joined(*mesh, {-3, 0, 0}, {3, height, 0}), height <= 0.3f);
    }
}

TEST(BakeWalkMesh, ClimbsStairs) {
    Level level;
    level.floor(-5, -5, 5, 5);
    for (int i = 0; i < 10; ++i) {
        const float x = 5 + 0.5f * static_cast<float>(i);
        level.box({x, 0, -1}, {x + 0.5f, 0.25f * static_cast<float>(i + 1), 1});
    }
    level.box({10, 2.4f, -3}, {16, 2.5f, 3});
    level.floor(10, -3, 16, 3);
    WalkMeshBakeReport report;
    const Result<WalkMesh> mesh = level.bake({.report = &report});
    ASSERT_TRUE(mesh) << mesh.problem().message;
    expect_clean(*mesh, report);
    EXPECT_TRUE(joined(*mesh, {0, 0, 0}, {13, 2.5f, 0}));
    EXPECT_TRUE(is_floor(*mesh, {13, 2.5f, 0}));
    EXPECT_TRUE(is_floor(*mesh, {13, 0, 0})) << "below the upper floor";
    EXPECT_FALSE(joined(*mesh, {0, 0, 0}, {13, 0, 0}));
    const Result<WalkMesh> low = level.bake({.max_step = 0.1f});
    ASSERT_TRUE(low) << low.problem().message;
    EXPECT_FALSE(joined(*low, {0, 0, 0}, {13, 2.5f, 0}));
}

TEST(BakeWalkMesh, ClimbsSlopesUpToTheSteepest) {
    // Angles whose tangents are 0.5, 1 and 2, each with the steepest below and above it.
    const struct { float rise, below, above; } slopes[] = {{0.5f, 0.45f, 0.48f}, {1, 0.77f, 0.8f}, {2, 1.09f, 1.12f}};
    for (const auto& slope : slopes) {
        SCOPED_TRACE(slope.rise);
        Level level;
        level.floor(-5, -2, 0, 2);
        level.slope({0, 0, -2}, {3, 3 * slope.rise, 2});
        level.floor(3, -2, 8, 2, 3 * slope.rise);
        WalkMeshBakeReport report;
        const Result<WalkMesh> not_climbed = level.bake({.max_slope = slope.below});
        ASSERT_TRUE(not_climbed) << not_climbed.problem().message;
        EXPECT_FALSE(joined(*not_climbed, {-3, 0, 0}, {6, 3 * slope.rise, 0}));
        const Result<WalkMesh> climbed = level.bake({.max_slope = slope.above, .report = &report});
        ASSERT_TRUE(climbed) << climbed.problem().message;
        expect_clean(*climbed, report);
        EXPECT_TRUE(joined(*climbed, {-3, 0, 0}, {6, 3 * slope.rise, 0}));
        EXPECT_TRUE(is_floor(*climbed, {1.5f, 1.5f * slope.rise, 0}, 1e-4));
    }
}

TEST(BakeWalkMesh, NeedsTheWidthAndTheHeightOfTheWalker) {
    const Vec3 left{1, 0, 3}, right{9, 0, 3};
    for (const float width : {0.6f, 0.75f, 1.3f, 2.0f}) {
        SCOPED_TRACE(width);
        const Result<WalkMesh> mesh = two_rooms(width, 3).bake();
        ASSERT_TRUE(mesh) << mesh.problem().message;
        EXPECT_EQ(joined(*mesh, left, right), width > 0.8f);
    }
    for (const float height : {1.2f, 1.75f, 1.95f, 2.5f}) {
        SCOPED_TRACE(height);
        const Result<WalkMesh> mesh = two_rooms(2, height).bake();
        ASSERT_TRUE(mesh) << mesh.problem().message;
        EXPECT_EQ(joined(*mesh, left, right), height > 1.8f);
    }
    const Result<WalkMesh> slim = two_rooms(0.6f, 1).bake({.radius = 0.1f, .height = 0.8f});
    ASSERT_TRUE(slim) << slim.problem().message;
    EXPECT_TRUE(joined(*slim, left, right));
}

TEST(BakeWalkMesh, TakesAnyDirectionAsUp) {
    const Level level = room_with_table();
    const Result<WalkMesh> upright = level.bake();
    ASSERT_TRUE(upright) << upright.problem().message;
    // The level rotated such that its second axis points along `up`.
    const glm::quat turns[] = {{1, 0, 0, 0}, {0.5f, 0.5f, 0.5f, 0.5f}, {0.5f, -0.5f, -0.5f, -0.5f},
                               {0, 1, 0, 0}, {0.8f, 0, 0.48f, 0.36f},  {0.1f, 0.7f, -0.1f, 0.7f}};
    for (const glm::quat& turn : turns) {
        const auto turned = [&](const Vec3& v) { return rotate(turn, v); };
        Level other = level;
        for (Vec3& point : other.points) point = turned(point);
        const Vec3 up = turned({0, 3, 0});
        SCOPED_TRACE(std::to_string(up.x) + " " + std::to_string(up.y) + " " + std::to_string(up.z));
        const Result<WalkMesh> mesh = other.bake({.up = up});
        ASSERT_TRUE(mesh) << mesh.problem().message;
        EXPECT_EQ(mesh->report().components, 2u);
        EXPECT_FALSE(changed(mesh->report()));
        for (std::uint32_t i = 0; i < mesh->triangles().size(); ++i)
            EXPECT_GT(dot(DVec<3>(mesh->normal({i, {1, 0, 0}})), DVec<3>(up)), 2.9);
        // Rotated back the floor is equal, except for the phase of the cells.
        double area = 0;
        for (const glm::uvec3& t : mesh->triangles()) {
            const DVec<3> a(mesh->points()[t.x]);
            area += 0.5 * length(cross(DVec<3>(mesh->points()[t.y]) - a, DVec<3>(mesh->points()[t.z]) - a));
        }
        EXPECT_NEAR(area, area_of(*upright), 0.1 * area);
    }
}

TEST(BakeWalkMesh, TakesTrianglesFromBothSidesOnRequest) {
    Level level;
    level.quad({0, 0, 0}, {5, 0, 0}, {5, 0, 5}, {0, 0, 5});
    EXPECT_EQ(code_of(level.bake()), ProblemCode::empty_input);
    const Result<WalkMesh> mesh = level.bake({.both_sides = true});
    ASSERT_TRUE(mesh) << mesh.problem().message;
    EXPECT_TRUE(is_floor(*mesh, {2.5f, 0, 2.5f}));
    EXPECT_GT(mesh->normal({0, {1, 0, 0}}).y, 0.99f);
}

TEST(BakeWalkMesh, IsTheSameOfAMesh) {
    const Level level = room_with_table();
    const Result<WalkMesh> a = level.bake(), b = bake_walk_mesh(*Mesh::build(level.points, level.triangles));
    ASSERT_TRUE(a && b);
    ASSERT_EQ(a->points().size(), b->points().size());
    for (std::size_t i = 0; i < a->points().size(); ++i) EXPECT_EQ(a->points()[i], b->points()[i]);
    EXPECT_EQ(a->report(), b->report());
}

TEST(BakeWalkMesh, FollowsHillsWithoutCracks) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Level level = terrain(16, 1 + 0.2f * static_cast<float>(seed), random);
        WalkMeshBakeReport report;
        const Result<WalkMesh> mesh = level.bake({.radius = 0.3f, .max_slope = 1.3f, .report = &report});
        ASSERT_TRUE(mesh) << mesh.problem().message;
        expect_clean(*mesh, report);
        EXPECT_EQ(mesh->report().components, 1u);
        EXPECT_EQ(mesh->report().non_manifold_vertices, 0u);
        // Corners are on the level, and points between them nearly.
        const Result<WalkMesh> ground = WalkMesh::build(level.points, level.triangles);
        ASSERT_TRUE(ground);
        for (const Vec3& point : mesh->points())
            EXPECT_TRUE(is_floor(*ground, point, 1e-4)) << point.x << " " << point.y << " " << point.z;
        double sum = 0;
        constexpr int samples = 400;
        for (int i = 0; i < samples; ++i) {
            const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(mesh->triangles().size()));
            const double first = random.unit(), second = (1 - first) * random.unit();
            const Vec3 place = mesh->to_world({triangle, Vec3(DVec<3>(first, second, 1 - first - second))});
            const Above above = at(*ground, place);
            ASSERT_TRUE(above.found);
            sum += std::abs(above.height - static_cast<double>(place.y));
        }
        EXPECT_LT(sum / samples, static_cast<double>(report.cell_height));
    }
}

TEST(BakeWalkMesh, IsWalkedAcross) {
    const Level room = room_with_table();
    const Result<WalkMesh> floor = room.bake();
    ASSERT_TRUE(floor) << floor.problem().message;
    const Walked walked = floor->walk(floor->nearest({1, 0, 1}), Vec3(8, 0, 0.5f));
    EXPECT_EQ(walked.met, WalkMet::nothing);
    EXPECT_LT(length(DVec<3>(floor->to_world(walked.place)) - DVec<3>(9, 0, 1.5)), 1e-5);

    constexpr std::uint64_t seed = 9;
    SCOPED_TRACE(seed);
    Random random(seed);
    const Result<WalkMesh> mesh = terrain(16, 1.5f, random).bake({.radius = 0.3f, .max_slope = 1.3f});
    ASSERT_TRUE(mesh) << mesh.problem().message;
    for (int i = 0; i < 50; ++i) {
        const WalkPoint from = mesh->nearest({random.uniform_float(-7, 7), 0, random.uniform_float(-7, 7)});
        const WalkPoint to = mesh->nearest({random.uniform_float(-7, 7), 0, random.uniform_float(-7, 7)});
        const std::optional<WalkPath> path = mesh->find_path(from, to);
        ASSERT_TRUE(path);
        const double apart = length(DVec<3>(mesh->to_world(to)) - DVec<3>(mesh->to_world(from)));
        EXPECT_LE(apart, path->length + 1e-4);
        EXPECT_LT(path->length, 2 * apart + 1);
    }
}

/// Hills with boxes on and in them.
Level ruins(Random& random) {
    Level level = terrain(16, 1.5f, random);
    for (int i = 0; i < 12; ++i) {
        const DVec<3> center = random.in_cube<3>() * 7.0;
        const double x = random.uniform(0.2, 2), y = random.uniform(0.1, 2), z = random.uniform(0.2, 2);
        level.box(Vec3(center - DVec<3>(x, y, z)), Vec3(center + DVec<3>(x, y, z)));
    }
    return level;
}

TEST(BakeWalkMesh, HasNoCracksAmongRuins) {
    std::size_t components = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Level level = ruins(random);
        WalkMeshBakeReport report;
        const Result<WalkMesh> mesh = level.bake({.radius = 0.25f, .max_slope = 1, .report = &report});
        ASSERT_TRUE(mesh) << mesh.problem().message;
        expect_clean(*mesh, report);
        components += mesh->report().components;
    }
    EXPECT_GT(components, 24u) << "the ruins are no obstacles";
}

TEST(BakeWalkMesh, KeepsTheRadiusFromWalls) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Level level;
        level.floor(-8, -8, 8, 8);
        std::vector<Aabb3> boxes;
        for (int i = 0; i < 12; ++i) {
            const float x = random.uniform_float(-7, 7), z = random.uniform_float(-7, 7);
            boxes.push_back({{x, -1, z}, {x + random.uniform_float(0.1, 3), 3, z + 1}});
            level.box(boxes.back().min, boxes.back().max);
        }
        WalkMeshBakeReport report;
        const Result<WalkMesh> mesh = level.bake({.radius = 0.5f, .report = &report});
        ASSERT_TRUE(mesh) << mesh.problem().message;
        expect_clean(*mesh, report);
        double least = 100;
        for (int i = 0; i < 2000; ++i) {
            const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(mesh->triangles().size()));
            const double first = random.unit();
            const Vec3 place = mesh->to_world({triangle, Vec3(DVec<3>(first, 1 - first, 0))});
            if (std::abs(place.y) > 1.0f) continue;
            for (const Aabb3& box : boxes) {
                const double x = std::max({0.0f, box.min.x - place.x, place.x - box.max.x});
                const double z = std::max({0.0f, box.min.z - place.z, place.z - box.max.z});
                least = std::min(least, std::sqrt(x * x + z * z));
            }
        }
        EXPECT_GT(least, 0.5 - static_cast<double>(report.cell));
        EXPECT_LT(least, 0.5 + 3 * static_cast<double>(report.cell));
    }
}

TEST(BakeWalkMesh, IsRightAtAnyScale) {
    for (const float scale : {1e-3f, 1.0f, 1e4f}) {
        SCOPED_TRACE(scale);
        Level level = room_with_table();
        for (Vec3& point : level.points) point = point * scale + Vec3(100 * scale, -50 * scale, 0);
        WalkMeshBakeOptions options;
        for (float* length : {&options.radius, &options.height, &options.max_step}) *length *= scale;
        const Result<WalkMesh> mesh = level.bake(options);
        ASSERT_TRUE(mesh) << mesh.problem().message;
        EXPECT_EQ(mesh->report().components, 2u);
        EXPECT_FALSE(changed(mesh->report()));
    }
}

TEST(BakeWalkMesh, ReportsProgressAndStopsOnRequest) {
    Random random(3);
    const Level level = terrain(16, 1, random);
    std::vector<double> reported;
    const auto note = [&](double done) {
        reported.push_back(done);
        return true;
    };
    ASSERT_TRUE(level.bake({.progress = note}));
    ASSERT_GT(reported.size(), 5u);
    EXPECT_EQ(reported.back(), 1.0);
    for (std::size_t i = 0; i < reported.size(); ++i) {
        EXPECT_GE(reported[i], i == 0 ? 0.0 : reported[i - 1]);
        std::size_t calls = 0;
        const auto stop = [&](double) { return calls++ < i; };
        EXPECT_EQ(code_of(level.bake({.progress = stop})), ProblemCode::cancelled);
        EXPECT_EQ(calls, i + 1) << "it went on";
    }
}

TEST(BakeWalkMesh, SaysWhatLeftNothing) {
    Level level;
    const auto why = [&](const WalkMeshBakeOptions& options) {
        const Result<WalkMesh> result = level.bake(options);
        EXPECT_EQ(code_of(result), ProblemCode::empty_input);
        return result ? std::string() : result.problem().message;
    };
    EXPECT_NE(why({}).find("at least one triangle"), std::string::npos);
    level.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
    EXPECT_NE(why({}).find("flat enough"), std::string::npos);
    level.floor(0, 0, 4, 4);
    level.quad({-1, 1, -1}, {5, 1, -1}, {5, 1, 5}, {-1, 1, 5});
    EXPECT_NE(why({}).find("height"), std::string::npos);
    level = {};
    level.floor(0, 0, 4, 4);
    EXPECT_NE(why({.radius = 3}).find("radius"), std::string::npos);
    EXPECT_NE(why({.min_area = 100}).find("minimum area"), std::string::npos);
}

TEST(BakeWalkMesh, NamesBadOptionsAndLevels) {
    const Level level = room_with_table();
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float number : {-1.0f, nan_float, infinity}) {
        SCOPED_TRACE(number);
        EXPECT_EQ(code_of(level.bake({.up = {0, number == -1 ? 0 : number, 0}})), ProblemCode::bad_argument);
        EXPECT_EQ(code_of(level.bake({.radius = number})), ProblemCode::bad_argument);
        EXPECT_EQ(code_of(level.bake({.height = number})), ProblemCode::bad_argument);
        EXPECT_EQ(code_of(level.bake({.max_step = number})), ProblemCode::bad_argument);
        EXPECT_EQ(code_of(level.bake({.max_slope = number})), ProblemCode::bad_argument);
        EXPECT_EQ(code_of(level.bake({.cell = number})), ProblemCode::bad_argument);
        EXPECT_EQ(code_of(level.bake({.min_area = number})), ProblemCode::bad_argument);
    }
    EXPECT_EQ(code_of(level.bake({.height = 0.3f})), ProblemCode::bad_argument);
    EXPECT_EQ(code_of(level.bake({.max_slope = 1.56f})), ProblemCode::bad_argument);
    EXPECT_EQ(code_of(level.bake({.radius = 0})), ProblemCode::bad_argument) << "there is nothing to choose a cell by";
    EXPECT_EQ(code_of(level.bake({.cell = 0.01f})), ProblemCode::bad_argument);
    EXPECT_EQ(code_of(level.bake({.radius = 1e-3f, .height = 4e-3f, .max_step = 1e-3f})), ProblemCode::too_large);
    const Result<WalkMesh> bad_start = level.bake({.starts = std::vector<Vec3>{{1, 0, 1}, {1, nan_float, 1}}});
    EXPECT_EQ(code_of(bad_start), ProblemCode::not_finite);
    EXPECT_EQ(bad_start.problem().index, 1u);

    Level bad = level;
    bad.points[3].z = nan_float;
    EXPECT_EQ(code_of(bad.bake()), ProblemCode::not_finite);
    bad = level;
    bad.triangles[2].y = 1000;
    EXPECT_EQ(code_of(bad.bake()), ProblemCode::index_out_of_range);
    bad = level;
    bad.floor(0, 0, 1, 1, 1e4f);
    EXPECT_EQ(code_of(bad.bake()), ProblemCode::too_large) << "as high as a mountain";
    bad.floor(1e20f, 0, 2e20f, 1);
    EXPECT_EQ(code_of(bad.bake()), ProblemCode::too_large);

    const Result<WalkMesh> point = level.bake({.radius = 0, .cell = 0.1f});
    ASSERT_TRUE(point) << point.problem().message;
    EXPECT_TRUE(joined(*point, {0.3f, 0, 0.3f}, {9.7f, 0, 9.7f}));
}

TEST(BakeWalkMesh, NamesFloorsThatAreTooMany) {
    Level level;
    for (int i = 0; i < 300; ++i) level.floor(0, 0, 0.5f, 0.5f, 0.2f * static_cast<float>(i));
    EXPECT_EQ(code_of(level.bake({.radius = 0.1f, .height = 0.1f, .max_slope = 0.1f, .max_step = 0.02f})),
              ProblemCode::too_large);
}

}  // namespace
}  // namespace abut
