// The hit normals of sweeps with rotation at floors made of pieces: a shape that tumbles onto a floor or rolls over it
// has no ghost collisions at internal edges, and does hit steps and ends.

#include "../../oracle/expect.hpp"
#include "../contact/floors.hpp"
#include <abut/query/sweep.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/world/world.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;
using namespace test;

constexpr std::uint64_t seed = 20261122;

/// The angle between a normal and the floor's, in radians.
template <int D>
double lean(const Vec<D>& normal) {
    DVec<D> aside(normal);
    if (!(aside[1] > 0)) return 2;
    aside[1] = 0;
    return length(aside);
}

/// A tumbling motion from above the floor to below, often faster along the floor than down.
template <int D>
Motion<D> tumble(Random& random, float radius) {
    Vec<D> from(0.0f), move(0.0f);
    for (int axis = 0; axis < D; ++axis) from[axis] = random.uniform_float(3, tiles - 3);
    // Every second motion goes to an internal edge.
    if (random.chance(0.5)) from[0] = std::round(from[0]);
    from[1] = radius * random.uniform_float(1.01, 1.3);
    for (int axis = 0; axis < D; ++axis) move[axis] = random.uniform_float(-1.5, 1.5);
    move[1] = -random.uniform_float(0.5, 1.5) * radius;
    Motion<D> result{{from, random.rotation<D>()}, move, {}};
    if constexpr (D == 2)
        result.turn = random.uniform_float(-6, 6);
    else
        result.turn = to_float(random.direction<3>() * random.uniform(0, 6));
    return result;
}

/// `off` is the tolerance of a normal's angle.
template <int D, class S, class Floor>
void expect_up(const char* name, const S& shape, float radius, const Floor& floor, double off) {
    Random random(seed);
    int hits = 0;
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << name << ' ' << i);
        const Motion<D> motion = tumble<D>(random, radius);
        const auto hit = sweep(shape, motion, floor);
        if (!hit) continue;
        ++hits;
        ASSERT_LE(lean<D>(hit->normal), off);
    }
    EXPECT_GT(hits, 50) << name;
}

template <class Floor>
void expect_up_in_space(const char* name, const Floor& floor, double off) {
    SCOPED_TRACE(name);
    expect_up<3>("box", Box3{{0, 0, 0}, {0.4f, 0.3f, 0.6f}}, 0.79f, floor, off);
    expect_up<3>("rod", Box3{{0, 0, 0}, {1, 0.05f, 0.05f}}, 1.01f, floor, off);
    expect_up<3>("capsule", Capsule3{{-0.6f, 0, 0}, {0.6f, 0, 0}, 0.2f}, 0.8f, floor, off);
    expect_up<3>("cylinder", Cylinder{{0, -0.3f, 0}, {0, 0.3f, 0}, 0.4f}, 0.5f, floor, off);
    expect_up<3>("plate", Box3{{0, 0, 0}, {0.7f, 0.02f, 0.7f}}, 1.0f, floor, off);
}
template <class Floor>
void expect_up_in_the_plane(const char* name, const Floor& floor, double off) {
    SCOPED_TRACE(name);
    expect_up<2>("box", Box2{{0, 0}, {0.4f, 0.3f}}, 0.5f, floor, off);
    expect_up<2>("rod", Box2{{0, 0}, {1, 0.05f}}, 1.01f, floor, off);
    expect_up<2>("capsule", Capsule2{{-0.6f, 0}, {0.6f, 0}, 0.2f}, 0.8f, floor, off);
}

TEST(SweepRotatingSurface, TumblingOntoAFloorHitsNoInternalEdges) {
    Random perturbation(seed);
    for (Random* random : {static_cast<Random*>(nullptr), &perturbation}) {
        const double off = random != nullptr ? 1e-3 : 1e-6;
        expect_up_in_space("mesh", level_mesh(random), off);
        // The filter sees gaps as wide as the perturbation from 1e-3 of the size above: about one in thousands.
        expect_up_in_space("broken mesh", broken_mesh(random), random != nullptr ? 0.03 : off);
        expect_up_in_space("boxes", boxes_in_space(random), off);
        expect_up_in_the_plane("boxes", boxes_of_the_plane(random), off);
        expect_up_in_the_plane("segments", segments(random), off);
    }
    const TileMap map = *TileMap::build(std::vector<Tile>(tiles, Tile::full), tiles, Vec2(1));
    expect_up_in_the_plane("tiles", at(map, Pose2{{0, -1}}), 1e-6);
    std::vector<Vec2> points;
    for (int i = tiles; i >= 0; --i) points.push_back({i, 0});
    for (const bool one_sided : {false, true})
        expect_up_in_the_plane("chain", *Chain::build(points, false, {.one_sided = one_sided}), 1e-6);
}

TEST(SweepRotatingSurface, OfSeparateItemsOfAWorldToo) {
    World3 world;
    for (const Box3& box : boxes_in_space(nullptr).pieces) world.add(box, {.fixed = true});
    world.update();
    const Box3 box{{0, 0, 0}, {0.4f, 0.3f, 0.6f}}, plate{{0, 0, 0}, {0.7f, 0.02f, 0.7f}};
    Random random(seed);
    int hits = 0, ghosts = 0;
    for (int i = 0; i < 400; ++i) {
        SCOPED_TRACE(i);
        const Box3& shape = i % 2 == 0 ? box : plate;
        const Motion3 motion = tumble<3>(random, 0.8f);
        const auto hit = world.sweep(shape, motion);
        const auto between = world.sweep(shape, motion.from, pose_at(motion, 1));
        if (between) {
            ASSERT_LE(lean<3>(between->hit.normal), 1e-6);
        }
        if (!hit) continue;
        ++hits;
        ASSERT_LE(lean<3>(hit->hit.normal), 1e-6);
        // The hit normal of that box alone sometimes differs.
        const auto alone = sweep(shape, motion, world.shape(hit->id));
        ghosts += alone && lean<3>(alone->normal) > 0.01 ? 1 : 0;
    }
    EXPECT_GT(hits, 200);
    EXPECT_GT(ghosts, 0);
}

// Sweeps that start at rest on the floor.

TEST(SweepRotatingSurface, RollingOverAFloorHitsNoInternalEdges) {
    Random random(seed);
    const auto expect = [&](const auto& floor) {
        int hits = 0;
        for (int i = 0; i < 40; ++i) {
            // A box on its edge tips over; a wheel of eight sides rolls and slips a little.
            const float x = random.chance(0.5) ? std::round(random.uniform_float(2, 6)) : random.uniform_float(2, 6);
            const Box3 box{{0.4f, 0.3f, 0}, {0.4f, 0.3f, 0.5f}};
            const Motion3 over{{{x, 0, random.uniform_float(3, 5)}}, {0, 0, 0}, {0, 0, 2.5f}};
            const auto tipped = sweep(box, over, floor);
            ASSERT_TRUE(tipped);
            // The wheel's side is nearly level there, and the previous edge is within the tolerance, so the normal may
            // be that side's.
            EXPECT_NEAR(tipped->fraction * 2.5, 3.14159265 / 2, 1e-2);
            EXPECT_LE(lean<3>(tipped->normal), 1e-2) << i;
            std::vector<Vec3> rim;
            for (int k = 0; k < 8; ++k)
                for (const float z : {-0.2f, 0.2f}) {
                    const Turn turn = Turn::by(0.785398163f * (static_cast<float>(k) + 0.5f));
                    rim.push_back({0.5f * turn.cos, 0.5f * turn.sin, z});
                }
            const Polyhedron wheel = *Polyhedron::build(rim);
            const float apothem = 0.5f * Turn::by(0.785398163f / 2).cos, by = random.uniform_float(-2, 2);
            const Motion3 rolls{{{x, apothem + 1e-4f, random.uniform_float(3, 5)}}, {by, 0, 0}, {0, 0, -by / 0.47f}};
            if (const auto rolled = sweep(wheel, rolls, floor)) {
                ++hits;
                EXPECT_LE(lean<3>(rolled->normal), 1e-6) << i;
            }
        }
        EXPECT_GT(hits, 15);
    };
    expect(level_mesh(nullptr));
    expect(broken_mesh(nullptr));
    expect(boxes_in_space(nullptr));
}

// Real steps and ends are hit.

TEST(SweepRotatingSurface, StepsAndEndsAreReported) {
    // A step of height 0.2 begins at 4.
    Pieces<Box2> step = boxes_of_the_plane(nullptr);
    step.pieces.push_back({{4.5f, 0.1f}, {0.5f, 0.1f}});
    const Box2 ram{{0, 0}, {0.3f, 0.05f}};
    const auto hit = sweep(ram, Motion2{{{3.5f, 0.1f}}, {1, 0}, 0.1f}, step);
    ASSERT_TRUE(hit);
    EXPECT_LT(hit->normal.x, -0.99f);
    EXPECT_EQ(hit->feature.part, static_cast<std::uint32_t>(tiles));
    // The step is twenty times as high as the threshold of the internal-edge filter.
    step.pieces.back() = {{4.5f, -0.48f}, {0.5f, 0.5f}};
    const Box2 crate{{0, 0.3f}, {0.5f, 0.3f}};
    const auto low = sweep(crate, Motion2{{{3.2f, 1e-4f}}, {1, 0}, 1e-4f}, step);
    ASSERT_TRUE(low);
    EXPECT_LT(low->normal.x, -0.99f);

    // A rod with its hinge above the floor comes down on the end of the floor: the normal is perpendicular to the rod.
    const Box2 rod{{-1, 0.05f}, {1, 0.05f}};
    const auto end = sweep(rod, Motion2{{{1, 0.3f}}, {}, 1}, boxes_of_the_plane(nullptr));
    ASSERT_TRUE(end);
    const double angle = std::atan(0.3);
    EXPECT_NEAR(end->fraction, angle, 1e-4);
    EXPECT_NEAR(end->normal.x, -std::sin(angle), 1e-4);
    EXPECT_NEAR(end->normal.y, std::cos(angle), 1e-4);
}

TEST(SweepRotatingSurface, IsTheSameWhereTheFloorMovesAndTurns) {
    // Relative to the floor, a box comes down on an internal edge.
    const auto floor = boxes_in_space(nullptr);
    const Box3 box{{0, 0, 0}, {0.4f, 0.3f, 0.6f}};
    Random random(seed);
    int hits = 0;
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(i);
        const Motion3 motion = tumble<3>(random, 0.79f);
        const Vec3 away = to_float(random.in_cube<3>() * 1000.0);
        Motion3 of_box = motion, of_floor{};
        // Both move by the same vector, and the floor rotates slightly about a point far from the hit.
        of_box.from.position += away;
        of_box.move += away;
        of_floor.from.position = of_floor.move = away;
        of_floor.turn = to_float(random.in_cube<3>() * 0.01);
        const auto hit = sweep(box, of_box, floor, of_floor);
        if (!hit) continue;
        ++hits;
        const Pose3 there = pose_at(of_floor, hit->fraction);
        const DVec<3> up = affine(there).vector({0, 1, 0});
        EXPECT_NEAR(dot(up, DVec<3>(hit->normal)), 1, 1e-6);
    }
    EXPECT_GT(hits, 50);
}

}  // namespace
}  // namespace abut
