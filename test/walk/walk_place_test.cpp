// Places on a walk mesh: their positions and normals, and vectors in the frames of triangles.

#include "../../scenes/bumpy_ball.hpp"
#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include "../shape/meshes.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::near;
using test::Surface;

constexpr std::uint64_t walk_place_seed = 20261123;

/// A roof: two triangles that share the edge (0, 0, 0) - (0, 2, 0), one level to the right, one steep to the left.
Surface roof() {
    return {{{0, 0, 0}, {0, 2, 0}, {3, 1, 0}, {-1, 1, -1}}, {{0, 2, 1}, {0, 1, 3}}};
}

TEST(WalkPlace, WeightsAreSharesOfTheirSum) {
    const WalkMesh mesh = *WalkMesh::build(roof().points, roof().triangles);
    for (const float scale : {1.0f, 3.0f, 1e-7f, 1e-38f, 1e37f}) {
        EXPECT_TRUE(near<3>(mesh.to_world({0, Vec3(1, 2, 1) * scale}), {1.5f, 1, 0})) << scale;
        EXPECT_TRUE(near<3>(mesh.normal({0, Vec3(1, 2, 1) * scale}), {0, 0, 1})) << scale;
        EXPECT_EQ(mesh.to_world({0, Vec3(0, 1, 0) * scale}), Vec3(3, 1, 0)) << scale;
    }
}

TEST(WalkPlace, SmoothNormalsAreThoseGiven) {
    // Normals may have any length. The triangle was reordered since, and each corner still has its own.
    Surface surface = roof();
    surface.triangles.push_back({0, 2, 4});
    surface.points.push_back({3, -1, 0});
    std::vector<Vec3> normals{{1, 0, 0}, {0, 5, 0}, {0, 0, 0.1f}, {0, 0, 1}, {-1e-30f, 0, 0}};
    const WalkMesh mesh = *WalkMesh::build(surface.points, surface.triangles, normals);
    ASSERT_EQ(mesh.report().turned, 1u);
    EXPECT_EQ(mesh.triangles()[2], glm::uvec3(0, 4, 2));
    EXPECT_TRUE(near<3>(mesh.smooth_normal({0, {1, 0, 0}}), {1, 0, 0}));
    EXPECT_TRUE(near<3>(mesh.smooth_normal({0, {0, 1, 0}}), {0, 0, 1}));
    EXPECT_TRUE(near<3>(mesh.smooth_normal({0, {0, 0, 1}}), {0, 1, 0}));
    EXPECT_TRUE(near<3>(mesh.smooth_normal({2, {0, 1, 0}}), {-1, 0, 0}));
    EXPECT_TRUE(near<3>(mesh.smooth_normal({2, {0, 0, 1}}), {0, 0, 1}));
    EXPECT_TRUE(near<3>(mesh.smooth_normal({0, {0.5f, 0, 0.5f}}), to_float(normalized(DVec<3>(1, 1, 0)))));
    // They cancel between corners 0 and 1 of the last triangle: the triangle's own normal remains.
    EXPECT_EQ(mesh.smooth_normal({2, {0.5f, 0.5f, 0}}), mesh.normal({2, {1, 0, 0}}));
}

TEST(WalkPlace, SmoothNormalsTakeSharesToo) {
    const std::vector<Vec3> normals{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}};
    const WalkMesh mesh = *WalkMesh::build(roof().points, roof().triangles, normals);
    for (const float scale : {1.0f, 1e-3f, 1e-7f, 1e-38f, 1e37f})
        EXPECT_TRUE(near<3>(mesh.smooth_normal({0, Vec3(1, 1, 1) * scale}), to_float(normalized(DVec<3>(1, 1, 1)))))
            << scale;
}

TEST(WalkPlace, SmoothNormalsGoOverEdges) {
    const WalkMesh mesh = *WalkMesh::build(roof().points, roof().triangles);
    // Equal from both triangles: between the two normals on the edge, the triangle's own at an unshared corner.
    const Vec3 from_right = mesh.smooth_normal({0, {0.25f, 0, 0.75f}});
    EXPECT_EQ(from_right, mesh.smooth_normal({1, {0.25f, 0.75f, 0}}));
    EXPECT_TRUE(oracle::is_unit<3>(from_right));
    EXPECT_LT(from_right.x, -0.1f);
    EXPECT_GT(from_right.z, 0.1f);
    EXPECT_TRUE(near<3>(mesh.smooth_normal({0, {0, 1, 0}}), {0, 0, 1}));
}

TEST(WalkPlace, SmoothNormalsOfABallPointOutwards) {
    oracle::Random random(walk_place_seed);
    const scenes::BumpyBall ball = scenes::bumpy_ball(24, 0, 0, random);
    const WalkMesh mesh = *WalkMesh::build(ball.points, ball.triangles);
    double smooth_error = 0, flat_error = 0;
    for (std::uint32_t i = 0; i < 5000; ++i) {
        const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(ball.triangles.size()));
        const float a = random.uniform_float(0, 1), b = random.uniform_float(0, 1), c = random.uniform_float(0, 1);
        const WalkPoint place{triangle, {a, b, c}};
        const DVec<3> out = normalized(DVec<3>(mesh.to_world(place)));
        EXPECT_TRUE(oracle::is_unit<3>(mesh.smooth_normal(place)));
        smooth_error = std::max(smooth_error, length(DVec<3>(mesh.smooth_normal(place)) - out));
        flat_error = std::max(flat_error, length(DVec<3>(mesh.normal(place)) - out));
    }
    EXPECT_LT(smooth_error, 0.01);
    EXPECT_LT(flat_error, 0.15);
    EXPECT_GT(flat_error, 0.03) << "there is something to smooth";
}

TEST(WalkPlace, SmoothNormalsEndWhereTheSurfaceTurnsOver) {
    // A strip of three squares with a twist: at its one mirrored edge both sides have normals of their own.
    const Surface strip{{{0, 0, 0}, {0, 0, 1}, {2, 0, 0}, {2, 0, 1}, {1, 2, 0.2f}, {1, 2, 0.8f}},
                        {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}, {4, 1, 0}, {4, 0, 5}}};
    const WalkMesh mesh = *WalkMesh::build(strip.points, strip.triangles);
    for (std::uint32_t i = 0; i < 6; ++i)
        for (const Vec3& weights : {Vec3(1, 1, 1), Vec3(1, 0, 0), Vec3(0, 1, 1)})
            EXPECT_GT(dot(DVec<3>(mesh.smooth_normal({i, weights})), DVec<3>(mesh.normal({i, weights}))), 0.2) << i;
}

TEST(WalkPlace, HasTheAreaOfItsTriangle) {
    const std::vector<std::uint8_t> areas{7, 255};
    EXPECT_EQ((*WalkMesh::build(roof().points, roof().triangles, {}, areas)).area(0), 7);
    EXPECT_EQ((*WalkMesh::build(roof().points, roof().triangles, {}, areas)).area(1), 255);
    EXPECT_EQ((*WalkMesh::build(roof().points, roof().triangles)).area(1), 0);
}

TEST(WalkPlace, TheFirstAxisOfATrianglesFrameLeadsToItsSecondCorner) {
    const WalkMesh mesh = *WalkMesh::build(roof().points, roof().triangles);
    EXPECT_TRUE(near<2>(mesh.to_plane(1, {0, 2, 0}), {2, 0}));
    const Vec2 top = mesh.to_plane(1, {-1, 1, -1});
    EXPECT_NEAR(top.x, 1, 1e-6);
    EXPECT_NEAR(top.y, std::sqrt(2.0f), 1e-6);
    EXPECT_TRUE(near<2>(mesh.to_plane(0, {0, 0, 5}), {0, 0})) << "at right angles to it";
    EXPECT_TRUE(near<3>(mesh.to_space(1, {2, 0}), {0, 2, 0}));
}

TEST(WalkPlace, VectorsGoToThePlaneAndBackAtAllScales) {
    oracle::Random random(walk_place_seed);
    for (const double scale : {1e-3, 0.1, 1.0, 30.0, 1e4})
        for (int i = 0; i < 2000; ++i) {
            const DVec<3> far = random.direction<3>() * (random.chance(0.5) ? 0 : 10 * scale);
            Surface surface;
            for (int k = 0; k < 3; ++k) surface.points.push_back(to_float(far + random.in_cube<3>() * scale));
            surface.triangles = {{0, 1, 2}};
            const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
            ASSERT_TRUE(mesh);
            const Vec2 vector(random.uniform_float(-1, 1), 0.7f);
            const Vec3 in_space = mesh->to_space(0, vector);
            EXPECT_TRUE(near<2>(mesh->to_plane(0, in_space), vector, 1e-6))
                << "walk_place_seed " << walk_place_seed << ", item " << i;
            EXPECT_NEAR(length(DVec<3>(in_space)), length(DVec<2>(vector)), 1e-6);
            EXPECT_NEAR(dot(DVec<3>(mesh->normal({0, {1, 1, 1}})), DVec<3>(in_space)), 0, 1e-6);
            // The frame is right-handed: first axis, second axis, normal.
            const DVec<3> first(mesh->to_space(0, {1, 0})), second(mesh->to_space(0, {0, 1}));
            EXPECT_TRUE(near<3>(to_float(cross(first, second)), mesh->normal({0, {1, 0, 0}})));
            const DVec<3> along = DVec<3>(surface.points[1]) - DVec<3>(surface.points[0]);
            EXPECT_NEAR(dot(normalized(along), first), 1, 1e-6);
        }
}

TEST(WalkPlace, CornersAreWhereTheyWereGiven) {
    oracle::Random random(walk_place_seed);
    for (const double scale : {1e-3, 1.0, 1e4}) {
        scenes::BumpyBall ball = scenes::bumpy_ball(8, 0.2, 0.02, random);
        for (Vec3& point : ball.points) point = to_float(DVec<3>(point) * scale);
        const WalkMesh mesh = *WalkMesh::build(ball.points, ball.triangles);
        EXPECT_EQ(mesh.report(), (WalkMeshReport{.components = 1})) << "closed, whatever its scale";
        for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i)
            for (int k = 0; k < 3; ++k) {
                Vec3 weights(0.0f);
                weights[k] = 1;
                const Vec3 corner = ball.points[mesh.triangles()[i][k]];
                EXPECT_TRUE(near<3>(mesh.to_world({i, weights}), corner, 1e-7 * scale));
                EXPECT_TRUE(oracle::is_unit<3>(mesh.normal({i, weights})));
            }
    }
}

}  // namespace
}  // namespace abut
