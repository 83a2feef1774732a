// Walks with known ends, and the invariants of every walk.

#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include "walk_check.hpp"
#include "walk_surfaces.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using oracle::near;

/// The place of this point, which is on the mesh.
WalkPoint at(const WalkMesh& mesh, const Vec3& point) {
    const WalkPoint place = mesh.nearest(point);
    EXPECT_TRUE(near<3>(mesh.to_world(place), point, 1e-5));
    return place;
}

void expect_all_walked(const WalkMesh& mesh, const Walked& walked, const Vec3& end, double length) {
    EXPECT_TRUE(near<3>(mesh.to_world(walked.place), end, 2e-6 * (1 + length)));
    EXPECT_NEAR(walked.length, length, 1e-6 * length);
    EXPECT_EQ(walked.lost, 0);
    EXPECT_EQ(walked.met, WalkMet::nothing);
    EXPECT_EQ(walked.side, WalkSide{});
    EXPECT_TRUE(are_valid_weights(walked.place.weights));
}

TEST(Walk, GoesStraightOnOverAFloor) {
    const WalkMesh mesh = built(flat(4, 4));
    const Walked walked = mesh.walk(at(mesh, {0.5f, 0.75f, 0}), Vec3(3, 2, 0));
    expect_all_walked(mesh, walked, {3.5f, 2.75f, 0}, std::sqrt(13.0));
    EXPECT_EQ(walked.crossings, 6u) << "three columns, two rows, one line of diagonals";
    EXPECT_EQ(walked.turn * Vec3(1, 2, 3), Vec3(1, 2, 3));
    EXPECT_FALSE(walked.turn.mirrored());
}

TEST(Walk, LeavesOutWhatIsAtRightAnglesToTheTriangle) {
    const WalkMesh mesh = built(flat(4, 4));
    expect_all_walked(mesh, mesh.walk(at(mesh, {1, 1, 0}), Vec3(1, 0, 7)), {2, 1, 0}, 1);
    const Walked none = mesh.walk(at(mesh, {1.25f, 1.5f, 0}), Vec3(0, 0, 7));
    expect_all_walked(mesh, none, {1.25f, 1.5f, 0}, 0);
    EXPECT_EQ(none.crossings, 0u);
}

TEST(Walk, TurnsAtEdges) {
    // Over the edge of a box, and down its side; the crate is as wide as it is long, 3 high.
    const WalkMesh mesh = built(box_surface({0, 0, 0}, {2, 2, 3}));
    const Walked walked = mesh.walk(at(mesh, {1.5f, 1, 3}), Vec3(1, 0.25f, 0));
    expect_all_walked(mesh, walked, {2, 1.25f, 2.5f}, std::sqrt(1.0625));
    EXPECT_TRUE(near<3>(walked.turn * Vec3(1, 0, 0), {0, 0, -1}));
    EXPECT_TRUE(near<3>(walked.turn * Vec3(0, 1, 0), {0, 1, 0}));
    EXPECT_TRUE(near<3>(walked.turn * Vec3(0, 0, 1), {1, 0, 0})) << "the normal";
    EXPECT_TRUE(near<3>(rotate(walked.turn.in_space(), {1, 0, 0}), {0, 0, -1}));
    EXPECT_FALSE(walked.turn.mirrored());
}

TEST(Walk, ComesHomeRoundABox) {
    const WalkMesh mesh = built(box_surface({0, 0, 0}, {2, 2, 3}));
    for (const Vec3& step : {Vec3(10, 0, 0), Vec3(-10, 0, 0), Vec3(0, 10, 0), Vec3(0, -10, 0)}) {
        const WalkPoint start = at(mesh, {0.75f, 0.6f, 3});
        const Walked walked = mesh.walk(start, step);
        expect_all_walked(mesh, walked, {0.75f, 0.6f, 3}, 10);
        EXPECT_TRUE(near<3>(walked.turn * step, step, 1e-5));
    }
}

TEST(Walk, IsTheSameOnACeiling) {
    // A cave's floor, and its mirror image as a ceiling.
    oracle::Random random(7);
    const scenes::Terrain terrain = scenes::random_terrain(8, random);
    Surface ceiling{terrain.points, terrain.triangles};
    for (Vec3& point : ceiling.points) point.y = -point.y;
    const WalkMesh below = *WalkMesh::build(terrain.points, terrain.triangles), above = built(reversed(ceiling));
    for (int i = 0; i < 500; ++i) {
        const std::uint32_t triangle = random.below(128);
        const Vec3 step = to_float(random.direction<3>() * random.uniform(0, 5));
        // Corners 1 and 2 are swapped.
        const Walked a = below.walk({triangle, {0.25f, 0.25f, 0.5f}}, step);
        const Walked b = above.walk({triangle, {0.25f, 0.5f, 0.25f}}, {step.x, -step.y, step.z});
        const Vec3 end = below.to_world(a.place);
        EXPECT_TRUE(near<3>(above.to_world(b.place), {end.x, -end.y, end.z}, 1e-4));
        EXPECT_EQ(a.met, b.met);
    }
}

TEST(Walk, PassesExactlyThroughCornersOfAFloor) {
    // Along the diagonals, along the lines, from corner to corner, and against the diagonals through all corners.
    const WalkMesh mesh = built(flat(10, 10));
    for (const Vec3& direction :
         {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0), Vec3(2, 1, 0), Vec3(-1, 2, 0)})
        for (const float sign : {1.0f, -1.0f})
            for (const Vec3& start : {Vec3(5, 5, 0), Vec3(5.5f, 5, 0), Vec3(5, 5.25f, 0), Vec3(5.5f, 5.5f, 0)}) {
                const Vec3 step = direction * (sign * 2);
                const Walked walked = mesh.walk(at(mesh, start), step);
                expect_all_walked(mesh, walked, start + step, length(DVec<3>(step)));
            }
}

TEST(Walk, StartsAtACornerOfAFloorInAnyOfItsTriangles) {
    const WalkMesh mesh = built(flat(4, 4));
    int starts = 0;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i)
        for (int k = 0; k < 3; ++k) {
            Vec3 weights(0);
            weights[k] = 1;
            const Vec3 start = mesh.to_world({i, weights});
            if (start.x == 0 || start.y == 0 || start.x == 4 || start.y == 4) continue;
            for (int turn = 0; turn < 64; ++turn) {
                const DVec<2> direction = scenes::on_circle(turn / 16.0) * 0.9;
                const Vec3 step = to_float(DVec<3>(direction.x, direction.y, 0));
                expect_all_walked(mesh, mesh.walk({i, weights}, step), start + step, 0.9);
                ++starts;
            }
        }
    EXPECT_EQ(starts, 9 * 6 * 64);
}

TEST(Walk, FollowsTheSurfaceOfATube) {
    // Along a helix, and once round: as on the sheet it was made of.
    const std::uint32_t sides = 12;
    const WalkMesh mesh = built(tube(sides, 40));
    double round = 0;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const DVec<2> a = scenes::on_circle(4.0 * i / sides), b = scenes::on_circle(4.0 * ((i + 1) % sides) / sides);
        round += length(b - a);
    }
    const WalkPoint start = at(mesh, {1, 0, 2});
    const DVec<2> a = scenes::on_circle(0), b = scenes::on_circle(4.0 / sides);
    const DVec<3> along = normalized(DVec<3>(b.x - a.x, b.y - a.y, 0));
    const WalkPoint first = mesh.walk(start, to_float(along * 1e-3)).place;
    for (const double turns : {1.0, 3.0, -2.0, 10.0}) {
        const Vec3 step = to_float(along * (turns * round) + DVec<3>(0, 0, 3));
        const Walked walked = mesh.walk(first, step);
        const Vec3 end = mesh.to_world(first) + Vec3(0, 0, 3);
        EXPECT_TRUE(near<3>(mesh.to_world(walked.place), end, 2e-5 * std::abs(turns)));
        EXPECT_EQ(walked.met, WalkMet::nothing);
    }
}

TEST(Walk, TheTwoDoorsAgree) {
    oracle::Random random(20261123);
    for (const NamedSurface& named : surfaces(3)) {
        const WalkMesh mesh = built(named.surface);
        for (int i = 0; i < 200; ++i) {
            const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(mesh.triangles().size()));
            if (!mesh.is_walkable(triangle)) continue;
            const Vec2 step = to_float(random.direction<2>() * (0.3 * edge_of(named.surface)));
            const WalkPoint place{triangle, {0.375f, 0.25f, 0.375f}};
            const Walked flat = mesh.walk(place, step), space = mesh.walk(place, mesh.to_space(triangle, step));
            EXPECT_TRUE(near<3>(mesh.to_world(flat.place), mesh.to_world(space.place), 1e-6 * size_of(named.surface)))
                << named.name << " " << i;
            EXPECT_EQ(flat.met, space.met);
        }
    }
}

TEST(Walk, StaysInItsComponent) {
    const WalkMesh mesh = built(flat_with_holes(16, oracle::Random(4)));
    oracle::Random random(5);
    for (int i = 0; i < 2000; ++i) {
        const WalkPoint place{random.below(static_cast<std::uint32_t>(mesh.triangles().size())), {0.25f, 0.25f, 0.5f}};
        const Walked walked = mesh.walk(place, to_float(random.direction<3>() * 20.0));
        EXPECT_EQ(mesh.component(walked.place.triangle), mesh.component(place.triangle));
    }
}

}  // namespace
}  // namespace abut::test
