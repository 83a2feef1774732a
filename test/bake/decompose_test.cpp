// Meshes to convex parts: unions of convex bodies give these bodies, others are covered within the limits.

#include "../../scenes/solid_meshes.hpp"
#include "../oracle/bake/part_quality.hpp"
#include "../oracle/random.hpp"
#include <abut/bake/decompose.hpp>
#include <abut/bake/solid.hpp>
#include <abut/shape/weld.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::PartQuality;
using scenes::SolidMesh;

SolidMesh box(const Vec3& low, const Vec3& high) {
    SolidMesh result = scenes::of_cubes({{"#"}});
    for (Vec3& p : result.points) p = low + p * (high - low);
    return result;
}

std::vector<Polyhedron> parts_of(const SolidMesh& mesh, const DecomposeOptions& options) {
    Result<std::vector<Polyhedron>> parts = decompose(mesh.points, mesh.triangles, options);
    EXPECT_TRUE(parts) << (parts ? "" : parts.problem().message);
    return parts ? *parts : std::vector<Polyhedron>{};
}

std::vector<std::vector<std::tuple<float, float, float>>> corners_of(const std::vector<Polyhedron>& parts) {
    std::vector<std::vector<std::tuple<float, float, float>>> result;
    for (const Polyhedron& part : parts) {
        result.emplace_back();
        for (const Vec3& p : part.points()) result.back().emplace_back(p.x, p.y, p.z);
    }
    std::sort(result.begin(), result.end());
    return result;
}

double volume_of(const std::vector<Polyhedron>& parts) {
    double sum = 0;
    for (const Polyhedron& part : parts) sum += part.volume();
    return sum;
}

/// The corners of the triangles and points within them.
void expect_covered(const SolidMesh& mesh, const std::vector<Polyhedron>& parts, double farthest) {
    const oracle::ConvexParts all(parts);
    double size = 0;
    for (const Vec3& p : mesh.points) size = std::max(size, largest(DVec<3>(p)));
    const double allowed = farthest + 4e-7 * size;  // the queries here are in floats
    oracle::Random random(7);
    const oracle::SurfacePoints surface(mesh.points, mesh.triangles);
    for (int i = 0; i < 2000; ++i) EXPECT_LE(all.distance(surface.next(random)), allowed);
    for (const Vec3& p : mesh.points) EXPECT_LE(all.distance(p), allowed);
}

/// Expects the parts to fill the mesh exactly.
void expect_exact(const SolidMesh& mesh, std::size_t parts) {
    DecomposeReport report;
    const std::vector<Polyhedron> found = parts_of(mesh, {.report = &report});
    EXPECT_EQ(found.size(), parts);
    const double volume = signed_volume(mesh.points, mesh.triangles);
    EXPECT_TRUE(report.closed);
    EXPECT_NEAR(report.mesh_volume, volume, 1e-9 * volume);
    EXPECT_NEAR(volume_of(found), volume, 1e-6 * volume);
    expect_covered(mesh, found, report.farthest);
    const Welded welded = weld(mesh.points, mesh.triangles);
    const PartQuality quality = oracle::quality_of(welded.points, welded.triangles, found, 5000, 1);
    EXPECT_LT(quality.extra, 1e-3);
    EXPECT_LT(quality.missing, 1e-3);
}

TEST(DecomposeMesh, ConvexBodiesComeBackAsTheyAreAlsoWhereTheyOverlap) {
    SolidMesh mesh = box({0, 0, 0}, {2, 1, 1});
    add(mesh, box({1, 0.25f, 0.25f}, {1.5f, 3, 0.5f}));
    add(mesh, moved(box({0, 0, 0}, {1, 1, 1}), 0.5f, {5, 0, 0}));
    const std::vector<Polyhedron> parts = parts_of(mesh, {});
    ASSERT_EQ(parts.size(), 3u);
    for (const Polyhedron& part : parts) EXPECT_EQ(part.points().size(), 8u);
    EXPECT_NEAR(volume_of(parts), 2 + 0.5 * 2.75 * 0.25 + 0.125, 1e-6);
    expect_covered(mesh, parts, 0);
}

TEST(DecomposeMesh, AnLIsTwoBoxes) {
    expect_exact(scenes::of_cubes({{"####", "#", "#"}}), 2);
}

// No face of it is perpendicular to an axis: only the planes of the faces at its reflex edge separate it exactly.
TEST(DecomposeMesh, ALeaningLIsTwoPartsToo) {
    SolidMesh mesh = scenes::of_cubes({{"####", "#", "#"}});
    for (Vec3& p : mesh.points) p = Vec3(1, 0.3f, 0.2f) * p.x + Vec3(0.7f, 1, -0.4f) * p.y + Vec3(-0.3f, 0.5f, 1) * p.z;
    expect_exact(mesh, 2);
}

TEST(DecomposeMesh, StairsAreAsManyBoxesAsSteps) {
    expect_exact(scenes::of_cubes({{"####"}, {"###"}, {"##"}, {"#"}}), 4);
}

TEST(DecomposeMesh, AHouseKeepsItsDoorAndWindows) {
    const SolidMesh house = scenes::house();
    expect_exact(house, 14);
    const std::vector<Polyhedron> found = parts_of(house, {});
    const oracle::ConvexParts parts(found);
    EXPECT_FALSE(parts.contain({5, 0.5f, 2}));
    EXPECT_FALSE(parts.contain({0.5f, 4, 3}));
    EXPECT_FALSE(parts.contain({5, 4, 3}));
}

TEST(DecomposeMesh, CubesThatTouchInEdgesComeApart) {
    expect_exact(scenes::of_cubes({{"# #", " # ", "# #"}, {" # ", "# #", " # "}}), 9);
}

TEST(DecomposeMesh, AHollowStaysHollow) {
    SolidMesh mesh = box({0, 0, 0}, {3, 3, 3});
    add(mesh, inside_out(box({1, 1, 1}, {2, 2, 2})));
    expect_exact(mesh, 6);
    EXPECT_FALSE(oracle::ConvexParts(parts_of(mesh, {})).contain({1.5f, 1.5f, 1.5f}));
}

TEST(DecomposeMesh, SizeAndPlaceChangeNothing) {
    const SolidMesh stairs = scenes::of_cubes({{"####"}, {"###"}, {"##"}, {"#"}});
    for (const float scale : {1e-3f, 1e4f}) {
        SCOPED_TRACE(scale);
        expect_exact(moved(stairs, scale, {0, 0, 0}), 4);
    }
    expect_exact(moved(stairs, 1, {1000, -2000, 500}), 4);
}

TEST(DecomposeMesh, AKnottedTubeIsCoveredWithinTheLimits) {
    const SolidMesh tube = scenes::knotted_tube(96, 12);
    for (const std::uint32_t corners : {0u, 16u}) {
        SCOPED_TRACE(corners);
        DecomposeReport report;
        const std::vector<Polyhedron> parts =
            parts_of(tube, {.max_parts = 24, .concavity = 0.01, .max_vertices = corners, .report = &report});
        EXPECT_LE(parts.size(), 24u);
        EXPECT_GE(parts.size(), 12u);
        const PartQuality quality = oracle::quality_of(tube.points, tube.triangles, parts, 8000, 2);
        EXPECT_LT(quality.extra, corners == 0 ? 0.15 : 0.3);
        EXPECT_LT(quality.missing, 1e-3);
        EXPECT_EQ(quality.uncovered, 0);
        EXPECT_LE(quality.corners, corners == 0 ? 1000 : corners);
        EXPECT_EQ(report.vertices, quality.all_corners);
        EXPECT_EQ(report.concavity.size(), parts.size());
        EXPECT_NEAR(report.parts_volume, volume_of(parts), 1e-9 * report.parts_volume);
        expect_covered(tube, parts, report.farthest);
    }
}

/// A closed bowl of radius 1: two layers of rings and a rim.
SolidMesh dish(double depth, double thickness) {
    constexpr std::uint32_t rings = 6, sides = 24;
    SolidMesh result;
    for (const bool upper : {false, true}) {
        const auto base = static_cast<std::uint32_t>(result.points.size());
        const auto number = [&](std::uint32_t ring, std::uint32_t side) {
            return ring == 0 ? base : base + 1 + (ring - 1) * sides + side % sides;
        };
        for (std::uint32_t ring = 0; ring <= rings; ++ring)
            for (std::uint32_t side = 0; side < (ring == 0 ? 1 : sides); ++side) {
                const double out = static_cast<double>(ring) / rings, angle = 2 * 3.14159265358979323846 * side / sides;
                result.points.push_back(to_float(DVec<3>(out * std::cos(angle), out * std::sin(angle),
                                                         depth * out * out + (upper ? thickness : 0))));
            }
        const auto add_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            result.triangles.emplace_back(a, upper ? b : c, upper ? c : b);
        };
        for (std::uint32_t ring = 0; ring < rings; ++ring)
            for (std::uint32_t side = 0; side < sides; ++side) {
                add_triangle(number(ring, side), number(ring + 1, side), number(ring + 1, side + 1));
                if (ring > 0) add_triangle(number(ring, side), number(ring + 1, side + 1), number(ring, side + 1));
            }
    }
    const auto layer = static_cast<std::uint32_t>(result.points.size() / 2), rim = layer - sides;
    for (std::uint32_t side = 0; side < sides; ++side) {
        const std::uint32_t a = rim + side, b = rim + (side + 1) % sides;
        result.triangles.emplace_back(a, b, layer + b);
        result.triangles.emplace_back(a, layer + b, layer + a);
    }
    return result;
}

// The hulls of two halves have more than 64 vertices. As thin as this they became boxes, whose corners stood 0.41 out.
TEST(DecomposeMesh, PartsOfThinDishesStayByTheirMesh) {
    for (const double thickness : {4e-6, 1e-5, 1e-4}) {
        SCOPED_TRACE(thickness);
        const SolidMesh mesh = dish(0.02, thickness);
        DecomposeReport report;
        const std::vector<Polyhedron> parts = parts_of(mesh, {.report = &report});
        EXPECT_TRUE(report.closed);
        for (const Polyhedron& part : parts)
            for (const Vec3& p : part.points()) EXPECT_LT(p.x * p.x + p.y * p.y, 1.05f);
        expect_covered(mesh, parts, report.farthest);
    }
}

// The middle of a pit's opening is 0.083 of half the block's length from its sides. Samples of the hull missed it: in
// 28 of 40 blocks with up to four pits a part closed one, with parts to spare.
TEST(DecomposeMesh, NoPartClosesAPitThatIsWiderThanConcavityAllows) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        oracle::Random random(seed);
        const std::string full(12, '#');
        std::vector<std::string> top(12, full);
        std::vector<Vec3> mouths;
        for (int pit = 0; pit < 2; ++pit) {
            const std::uint32_t x = 1 + random.below(10), y = 1 + random.below(10);
            top[y][x] = ' ';
            mouths.emplace_back(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 2.99f);
        }
        const std::vector<std::string_view> floor(12, full);
        const SolidMesh block = scenes::of_cubes({floor, floor, {top.begin(), top.end()}});
        const std::vector<Polyhedron> parts = parts_of(block, {.max_parts = 64, .concavity = 0.05});
        EXPECT_LT(parts.size(), 64u);
        for (const Vec3& mouth : mouths) EXPECT_FALSE(oracle::ConvexParts(parts).contain(mouth));
    }
}

TEST(DecomposeMesh, LessConcavityTakesMoreParts) {
    const SolidMesh tube = scenes::knotted_tube(64, 8);
    std::size_t last = 0;
    for (const double concavity : {1.0, 0.3, 0.1}) {
        DecomposeReport report;
        const std::vector<Polyhedron> parts = parts_of(tube, {.concavity = concavity, .report = &report});
        EXPECT_GT(parts.size(), last);
        last = parts.size();
        for (const double found : report.concavity) EXPECT_LE(found, concavity);
    }
}

TEST(DecomposeMesh, WhatIsOpenIsAShell) {
    SolidMesh hollow = box({0, 0, 0}, {4, 4, 4});
    hollow.triangles.resize(10);
    DecomposeReport report;
    const std::vector<Polyhedron> walls = parts_of(hollow, {.report = &report});
    EXPECT_FALSE(report.closed);
    EXPECT_EQ(report.mesh_volume, 0);
    EXPECT_EQ(walls.size(), 5u);
    EXPECT_LT(volume_of(walls), 1e-3);
    expect_covered(hollow, walls, report.farthest);
    EXPECT_FALSE(oracle::ConvexParts(walls).contain({2, 2, 2}));
}

TEST(DecomposeMesh, AFlatOutlineIsCutToo) {
    const SolidMesh mesh{{{0, 0, 1}, {4, 0, 1}, {4, 1, 1}, {1, 1, 1}, {1, 4, 1}, {0, 4, 1}},
                         {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}};
    const std::vector<Polyhedron> parts = parts_of(mesh, {});
    EXPECT_EQ(parts.size(), 2u);
    double area = 0;
    for (const Polyhedron& part : parts) {
        EXPECT_EQ(part.rank(), 2);
        area += part.area() / 2;
    }
    EXPECT_NEAR(area, 7, 1e-5);
    expect_covered(mesh, parts, 0);
}

TEST(DecomposeMesh, ATriangleIsItsOwnPart) {
    const SolidMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const std::vector<Polyhedron> parts = parts_of(mesh, {});
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].points().size(), 3u);
}

TEST(DecomposeMesh, TooManyBodiesAreJoined) {
    SolidMesh mesh;
    for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y) {
            const Vec3 low(2.0f * static_cast<float>(x), 2.0f * static_cast<float>(y), 0);
            add(mesh, box(low, low + Vec3(1)));
        }
    EXPECT_EQ(parts_of(mesh, {.max_parts = 100}).size(), 64u);
    const std::vector<Polyhedron> few = parts_of(mesh, {.max_parts = 5});
    EXPECT_EQ(few.size(), 5u);
    expect_covered(mesh, few, 0);
    EXPECT_EQ(parts_of(mesh, {.max_parts = 1}).size(), 1u);
}

TEST(DecomposeMesh, TheSameInputGivesTheSameBitsAndAnyOrderTheSameParts) {
    SolidMesh house = scenes::house();
    const std::vector<Polyhedron> once = parts_of(house, {});
    EXPECT_EQ(corners_of(once), corners_of(parts_of(house, {})));
    oracle::Random random(3);
    for (std::size_t i = house.triangles.size() - 1; i > 0; --i)
        std::swap(house.triangles[i],
                  house.triangles[static_cast<std::size_t>(random.uniform(0, static_cast<double>(i + 1)))]);
    EXPECT_NEAR(volume_of(parts_of(house, {})), volume_of(once), 1e-6 * volume_of(once));
}

TEST(DecomposeMesh, ProgressGrowsAndCanCancel) {
    const SolidMesh house = scenes::house();
    double last = 0;
    std::size_t calls = 0;
    const auto watch = [&](double done) {
        EXPECT_GE(done, last);
        EXPECT_LE(done, 1);
        last = done;
        return ++calls > 0;
    };
    EXPECT_TRUE(decompose(house.points, house.triangles, {.progress = watch}));
    EXPECT_EQ(last, 1);
    EXPECT_GT(calls, 5u);
    const std::size_t all = calls;
    for (const std::size_t stop : {std::size_t{1}, all / 2, all}) {
        std::size_t count = 0;
        const auto cancel = [&](double) { return ++count < stop; };
        const Result<std::vector<Polyhedron>> result = decompose(house.points, house.triangles, {.progress = cancel});
        ASSERT_FALSE(result);
        EXPECT_EQ(result.problem().code, ProblemCode::cancelled);
    }
}

TEST(DecomposeMesh, ProblemsAreReported) {
    const SolidMesh good = box({0, 0, 0}, {1, 1, 1});
    const auto code = [](const SolidMesh& mesh, const DecomposeOptions& options = {}) {
        const Result<std::vector<Polyhedron>> result = decompose(mesh.points, mesh.triangles, options);
        return result ? std::optional<ProblemCode>() : std::optional(result.problem().code);
    };
    EXPECT_EQ(code(good), std::nullopt);
    EXPECT_EQ(code({}), ProblemCode::empty_input);
    EXPECT_EQ(code({{{1, 1, 1}}, {{0, 0, 0}}}), ProblemCode::empty_input);
    EXPECT_EQ(code(good, {.max_parts = 0}), ProblemCode::bad_argument);
    EXPECT_EQ(code(good, {.max_vertices = 3}), ProblemCode::bad_argument);
    EXPECT_EQ(code(good, {.concavity = -1}), ProblemCode::bad_argument);
    SolidMesh bad = good;
    bad.triangles[2].y = 1000;
    EXPECT_EQ(code(bad), ProblemCode::index_out_of_range);
    bad = good;
    bad.points[1].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(code(bad), ProblemCode::not_finite);
}

TEST(DecomposeMesh, AMeshIsDecomposedAsItsTriangles) {
    const SolidMesh stairs = scenes::of_cubes({{"##"}, {"#"}});
    const Result<Mesh> mesh = Mesh::build(stairs.points, stairs.triangles);
    ASSERT_TRUE(mesh);
    EXPECT_EQ(corners_of(*decompose(*mesh)), corners_of(parts_of(stairs, {})));
}

}  // namespace
}  // namespace abut
