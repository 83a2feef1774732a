// A mover on levels: no ghost collisions at internal edges, walking on slopes, and passing platforms from below.

#include "levels.hpp"
#include <abut/motion/mover.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

constexpr float gravity = 0.02f;

/// A capsule of height 2 around its center.
template <int D>
Capsule<D> hero(int up) {
    Vec<D> a(0.0f), b(0.0f);
    a[up] = -0.5f;
    b[up] = 0.5f;
    return {a, b, 0.5f};
}
Box2 crate() {
    return {{0, 0}, {0.4f, 1}};
}

/// A mover that walks, jumps and falls.
template <int D>
struct Walker {
    explicit Walker(const World<D>& in, int axis) : world(in), up(axis), mover({.up = unit_of(axis)}) {}

    static Vec<D> unit_of(int axis) {
        Vec<D> result(0.0f);
        result[axis] = 1;
        return result;
    }
    template <class S>
    void go(const S& shape, const Vec<D>& motion) {
        moved = mover.move(world, shape, position, motion);
        position = moved.position;
    }
    template <class S>
    void fall(const S& shape, int frames) {
        for (int i = 0; i < frames; ++i) go(shape, unit_of(up) * -gravity);
    }

    const World<D>& world;
    int up;
    Mover<D> mover;
    Vec<D> position{};
    Moved<D> moved{};
};

/// Walks in one direction over level ground and checks that nothing stops the mover, which starts grounded.
template <int D, class S>
void expect_no_catch(Walker<D>& walker, const S& shape, const Vec<D>& velocity, int frames, double off) {
    const Vec<D> from = walker.position;
    for (int i = 0; i < frames; ++i) {
        walker.go(shape, velocity - Walker<D>::unit_of(walker.up) * gravity);
        ASSERT_TRUE(walker.moved.grounded) << i;
        for (const MoverTouch<D>& touch : walker.moved.touches) ASSERT_NEAR(touch.normal[walker.up], 1, off) << i;
    }
    const DVec<D> error = DVec<D>(walker.position - from) - DVec<D>(velocity) * static_cast<double>(frames);
    EXPECT_LT(length(error), 1e-3 + off * length(DVec<D>(velocity)) * frames);
}

/// Ground of 20 x 2 tiles with its surface at height 1, a slope at 8 from there to height 2, down again at 14; and a
/// platform from 2 to 6 at height 4.
TileMap tiles() {
    constexpr std::uint32_t columns = 20;
    std::vector<Tile> result(columns * 5, Tile::empty);
    const auto put = [&](std::uint32_t from, std::uint32_t to, std::uint32_t row, Tile tile) {
        for (std::uint32_t x = from; x < to; ++x) result[row * columns + x] = tile;
    };
    put(0, columns, 0, Tile::full);
    put(8, 9, 1, Tile::slope_high_x_low_y);
    put(9, 14, 1, Tile::full);
    put(14, 15, 1, Tile::slope_low_x_low_y);
    put(2, 6, 3, Tile::one_way_high_y);
    return *TileMap::build(result, columns, 1.0f);
}

/// Walks over the tiles from left to right and back.
template <class S>
void walk_over_tiles(const S& shape, float speed) {
    World2 world;
    world.add(tiles(), {.fixed = true});
    Walker<2> walker(world, 1);
    walker.position = {7, 2.05f};
    walker.fall(shape, 20);
    const float low = walker.position.y;
    EXPECT_NEAR(low, 2, 0.03);
    const int frames = static_cast<int>(10 / speed);
    for (const float velocity : {speed, -speed}) {
        float highest = 0, farthest = 0;
        for (int i = 0; i < frames; ++i) {
            walker.go(shape, {velocity, -gravity});
            ASSERT_TRUE(walker.moved.grounded) << speed << ' ' << i << ' ' << walker.position.x;
            ASSERT_EQ(walker.moved.pushed, Vec2(0)) << speed << ' ' << i << ' ' << walker.position.x;
            highest = std::max(highest, walker.position.y);
            farthest = std::max(farthest, std::abs(walker.position.x - 7));
        }
        EXPECT_NEAR(highest, low + 1, 0.03) << speed;
        // The path goes over both slopes, which take a little longer.
        EXPECT_GT(farthest, 8.5) << speed;
    }
    EXPECT_NEAR(walker.position.y, low, 0.03) << speed;
}

TEST(MoverOnLevels, WalksOverTilesAndTheirSlopes) {
    for (const float speed : {0.013f, 0.1f, 0.31f}) {
        walk_over_tiles(hero<2>(1), speed);
        walk_over_tiles(crate(), speed);
    }
}

TEST(MoverOnLevels, HasNoGhostsAtEdgesOfTiles) {
    World2 world;
    world.add(tiles(), {.fixed = true});
    for (const float speed : {0.013f, 0.1f, 0.31f}) {
        for (const float height : {2.05f, 5.05f}) {
            Walker<2> walker(world, 1);
            walker.position = {2.6f, height};
            walker.fall(hero<2>(1), 20);
            expect_no_catch<2>(walker, hero<2>(1), {speed, 0}, static_cast<int>(3 / speed), 1e-5);
            walker.position = {2.6f, height};
            walker.fall(crate(), 20);
            expect_no_catch<2>(walker, crate(), {speed, 0}, static_cast<int>(3 / speed), 1e-5);
        }
    }
}

/// Jumps below the platform at a speed, without a filter; returns the position at rest.
template <class S>
float height_after_jump(const World2& world, const S& shape, float from, float speed) {
    Walker<2> walker(world, 1);
    walker.position = {from, 2.05f};
    walker.fall(shape, 20);
    EXPECT_TRUE(walker.moved.grounded);
    for (int i = 0; i < 200; ++i) {
        const float before = walker.position.y;
        walker.go(shape, {0, speed});
        // The mover is not grounded and not stopped on its way up.
        EXPECT_LT(walker.position.y - before, std::max(speed, 0.0f) + 0.06f) << i;
        if (speed > 0) {
            EXPECT_GT(walker.position.y - before, speed - 1e-4f) << i;
        }
        EXPECT_NEAR(walker.position.x, from, 1e-4) << i;
        speed = walker.moved.grounded ? -gravity : speed - 0.008f;
    }
    EXPECT_TRUE(walker.moved.grounded);
    return walker.position.y;
}

/// `standing` is the height of the shape's center above the ground.
template <class S>
void expect_one_way(const World2& world, const S& shape) {
    int on_top = 0, below = 0;
    for (int i = 0; i < 60; ++i) {
        const float speed = 0.1f + 0.003f * static_cast<float>(i);
        for (const float from : {3.0f, 3.37f, 2.1f}) {
            const float height = height_after_jump(world, shape, from, speed);
            // The height is v^2 / (2 a), in discrete steps.
            const float rise = 0.5f * speed * speed / 0.008f + 0.5f * speed;
            if (rise > 3.01f) {
                EXPECT_NEAR(height, 5, 0.03) << speed << ' ' << from;
                ++on_top;
            } else if (rise < 2.85f) {
                EXPECT_NEAR(height, 2, 0.03) << speed << ' ' << from;
                ++below;
            }
            if (testing::Test::HasFailure()) return;
        }
    }
    EXPECT_GT(on_top, 20);
    EXPECT_GT(below, 20);
}

TEST(MoverOnLevels, PassesOneWayTilesFromBelowAndStandsOnThem) {
    World2 world;
    world.add(tiles(), {.fixed = true});
    expect_one_way(world, hero<2>(1));
    expect_one_way(world, crate());
}

TEST(MoverOnLevels, PassesAOneSidedChainFromBelowAndStandsOnIt) {
    World2 world;
    world.add(tiles(), {.fixed = true});
    // Its front faces up, as that of the tiles' platform does.
    world.add(*Chain::build({{6, 4}, {4.5f, 4}, {3.37f, 4}, {3, 4}, {1.5f, 4}}, false, {.one_sided = true}),
              {.fixed = true});
    expect_one_way(world, hero<2>(1));
    expect_one_way(world, crate());
}

TEST(MoverOnLevels, RidesAOneSidedPlatform) {
    World2 world;
    const Id lift = world.add(*Chain::build({{2, 0}, {0, 0}, {-2, 0}}, false, {.one_sided = true}));
    Walker<2> walker(world, 1);
    walker.position = {0.3f, 1.05f};
    walker.fall(hero<2>(1), 20);
    for (int i = 1; i <= 100; ++i) {
        const float height = (i < 50 ? 0.17f : -0.17f) * static_cast<float>(i < 50 ? i : i - 100);
        world.move(lift, {{0, height}});
        walker.fall(hero<2>(1), 1);
        ASSERT_TRUE(walker.moved.grounded) << i;
        ASSERT_NEAR(walker.position.y, 1 + height, 0.03) << i;
    }
}

TEST(MoverOnLevels, HasNoGhostsAtCornersOfAStraightChain) {
    oracle::Random random(7);
    for (const bool one_sided : {false, true}) {
        std::vector<Vec2> points;
        for (float x = 12; x > -12; x -= random.uniform_float(0.02, 1.5)) points.emplace_back(x, 0);
        World2 world;
        world.add(*Chain::build(points, false, {.one_sided = one_sided}), {.fixed = true});
        for (const float speed : {0.013f, 0.1f, 0.31f}) {
            Walker<2> walker(world, 1);
            walker.position = {-5, 1.05f};
            walker.fall(hero<2>(1), 20);
            expect_no_catch<2>(walker, hero<2>(1), {speed, 0}, static_cast<int>(9 / speed), 1e-5);
            walker.position = {5, 1.05f};
            walker.fall(crate(), 20);
            expect_no_catch<2>(walker, crate(), {-speed, 0}, static_cast<int>(9 / speed), 1e-5);
        }
    }
}

TEST(MoverOnLevels, WalksOverHillsOfAChain) {
    oracle::Random random(8);
    std::vector<Vec2> points;
    for (float x = 20; x > -20; x -= 0.7f) points.emplace_back(x, random.uniform_float(-0.2, 0.2));
    for (const bool one_sided : {false, true}) {
        World2 world;
        world.add(*Chain::build(points, false, {.one_sided = one_sided}), {.fixed = true});
        Walker<2> walker(world, 1);
        walker.position = {-15, 1.4f};
        walker.fall(hero<2>(1), 40);
        for (int i = 0; i < 250; ++i) {
            const float before = walker.position.x;
            walker.go(hero<2>(1), {0.1f, -gravity});
            ASSERT_TRUE(walker.moved.grounded) << i;
            ASSERT_GT(walker.position.x, before + 0.05f) << i;
            ASSERT_TRUE(world.overlapping(at(hero<2>(1), Pose2{walker.position})).empty()) << i;
        }
    }
}

TEST(MoverOnLevels, HasNoGhostsAtEdgesOfAHeightField) {
    const std::vector<float> heights(33 * 33, 0.25f);
    World3 world;
    world.add(at(*HeightField::build(heights, 33, 0.5f), Pose3{{-8, -8, 0}}), {.fixed = true});
    oracle::Random random(9);
    for (const float speed : {0.02f, 0.1f, 0.4f})
        for (int run = 0; run < 8; ++run) {
            const DVec<2> along = run < 2 ? DVec<2>{1.0 - run, 1.0 * run} : random.direction<2>();
            Walker<3> walker(world, 2);
            walker.position = {0, 0, 1.3f};
            walker.fall(hero<3>(2), 20);
            const Vec3 velocity{static_cast<float>(along.x) * speed, static_cast<float>(along.y) * speed, 0};
            expect_no_catch<3>(walker, hero<3>(2), velocity, std::min(60, static_cast<int>(6 / speed)), 1e-5);
        }
}

/// Starts above the center of the world and walks in random directions: the mover stays on the ground and never in it.
void expect_walks_over_hills(const World3& world, oracle::Random& random, float height, int frames_to_fall) {
    for (int run = 0; run < 6; ++run) {
        Walker<3> walker(world, 2);
        walker.position = {0, 0, height};
        walker.fall(hero<3>(2), frames_to_fall);
        const DVec<2> along = random.direction<2>() * 0.1;
        const Vec3 velocity{static_cast<float>(along.x), static_cast<float>(along.y), -gravity};
        for (int i = 0; i < 100; ++i) {
            const Vec3 before = walker.position;
            walker.go(hero<3>(2), velocity);
            ASSERT_TRUE(walker.moved.grounded) << run << ' ' << i;
            ASSERT_GT(dot(DVec<3>(walker.position - before), DVec<3>(along.x, along.y, 0)), 0.005) << run << ' ' << i;
            ASSERT_TRUE(world.overlapping(at(hero<3>(2), Pose3{walker.position})).empty()) << run << ' ' << i;
        }
    }
}

TEST(MoverOnLevels, WalksOverHillsOfAHeightField) {
    oracle::Random random(10);
    std::vector<float> heights;
    for (int i = 0; i < 40 * 40; ++i) heights.push_back(random.uniform_float(-0.15, 0.15));
    World3 world;
    world.add(at(*HeightField::build(heights, 40, 0.7f), Pose3{{-14, -14, 0}}), {.fixed = true});
    expect_walks_over_hills(world, random, 1.4f, 40);
}

/// A SolidBsp of the faces of hills with an underside, whose cells have T-junctions.
TEST(MoverOnLevels, WalksOverHillsOfASolid) {
    oracle::Random random(11);
    const Surface ground = random_terrain(random, 24, 0.3).solid(-2);
    const SolidBsp3 solid = *SolidBsp3::build(ground.points, ground.triangles);
    World3 world;
    const Vec3 middle = center(bounds(solid));
    world.add(at(solid, Pose3{{-middle.x, -middle.y, 0}}), {.fixed = true});
    expect_walks_over_hills(world, random, 2, 80);
}

/// A SolidBsp of boxes side by side, with every second row shifted: corners touch sides.
TEST(MoverOnLevels, HasNoGhostsAtEdgesOfASolid) {
    oracle::Random random(12);
    Surface tiles;
    for (int y = -8; y < 8; ++y)
        for (int x = -8; x < 8; ++x) {
            const Vec3 low(static_cast<float>(x) + (y % 2 == 0 ? 0.0f : 0.37f), y, -1);
            tiles = joined(tiles, box_surface(low, low + Vec3(1)));
        }
    World3 world;
    world.add(*SolidBsp3::build(tiles.points, tiles.triangles), {.fixed = true});
    for (const float speed : {0.02f, 0.1f, 0.4f})
        for (int run = 0; run < 8; ++run) {
            const DVec<2> along = run < 2 ? DVec<2>{1.0 - run, 1.0 * run} : random.direction<2>();
            Walker<3> walker(world, 2);
            walker.position = {0, 0, 1.05f};
            walker.fall(hero<3>(2), 20);
            const Vec3 velocity{static_cast<float>(along.x) * speed, static_cast<float>(along.y) * speed, 0};
            expect_no_catch<3>(walker, hero<3>(2), velocity, std::min(60, static_cast<int>(6 / speed)), 1e-5);
        }
}

}  // namespace
}  // namespace abut::test
