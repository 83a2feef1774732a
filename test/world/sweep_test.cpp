// Sweeps through a world: examples with known answers.

#include "support/before_and_after_update.hpp"
#include "support/bits.hpp"
#include "support/circles.hpp"
#include "support/random_shapes.hpp"
#include <abut/query/sweep.hpp>
#include <abut/shape/chain.hpp>

#include <array>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

constexpr std::array all_kinds{BroadPhaseKind::brute_force,     BroadPhaseKind::grid, BroadPhaseKind::layered_grid,
                               BroadPhaseKind::sweep_and_prune, BroadPhaseKind::bvh,  BroadPhaseKind::bsp};

TEST(WorldSweep, HitsTheFirstOnItsPath) {
    World2 world;
    world.add(unit, {.pose = place(8)});
    const Id near = world.add(unit, {.pose = place(-4)});
    world.add(unit, {.pose = place(2), .fixed = true});
    before_and_after_update(world, [&] {
        const auto hit = world.sweep(Circle{{-10, 0}, 1}, {8, 0});
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->id, near);
        EXPECT_NEAR(hit->hit.fraction, 0.5f, 1e-5f);
        EXPECT_NEAR(hit->hit.distance, 4, 1e-4f);
        EXPECT_NEAR(hit->hit.normal.x, -1, 1e-6f);
        EXPECT_NEAR(hit->hit.point.x, -5, 1e-4f);
        EXPECT_FALSE(world.sweep(Circle{{-10, 0}, 1}, {3.9f, 0}));
        EXPECT_FALSE(world.sweep(Circle{{-10, 3}, 0.5f}, {30, 0}));
        EXPECT_FALSE(world.sweep(Circle{{-10, 0}, 1}, {0, 0}));
    });
}

TEST(WorldSweep, LowestIdWinsAmongEquallyEarly) {
    for (const BroadPhaseKind kind : all_kinds) {
        World2 world({.broad_phase = kind});
        std::vector<Id> ids;
        for (int i = 0; i < 40; ++i) ids.push_back(world.add(unit, {.pose = place(5), .fixed = i % 3 == 1}));
        for (const std::size_t moved : {0u, 7u}) {
            world.update();
            for (std::size_t i = 0; i < moved; ++i) world.move(ids[i], {{5, 0}, {0, i % 2 == 0 ? 1.0f : -1.0f}});
            EXPECT_EQ(world.sweep(unit, {20, 0})->id, ids[0]);
            EXPECT_EQ(world.sweep(unit, {20, 0}, {.ignore = ids[0]})->id, ids[1]);
            EXPECT_EQ(world.sweep(unit, Motion2{.move = {20, 0}, .turn = 1})->id, ids[0]);
            EXPECT_EQ(world.sweep(unit, place(0), place(20))->id, ids[0]);
        }
    }
}

TEST(WorldSweep, RestingCrateSlidesAndIsStoppedBehindItsFloor) {
    World2 world;
    for (int i = 0; i < 10; ++i)
        world.add(Box2{{static_cast<float>(i), -0.5f}, {0.5f, 0.5f}}, {.fixed = true});  // tiles with seams
    const Id wall = world.add(Box2{{8, 1}, {0.5f, 1}}, {.fixed = true});
    before_and_after_update(world, [&] {
        const Box2 crate{{1, 0.5f}, {0.5f, 0.5f}};
        const auto hit = world.sweep(crate, {12, 0});
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->id, wall);
        EXPECT_NEAR(hit->hit.distance, 6, 1e-4f);
        EXPECT_EQ(hit->hit.normal, Vec2(-1, 0));
        EXPECT_FALSE(world.sweep(crate, {5.9f, 0}));
        EXPECT_FALSE(world.sweep(crate, {0, 5})) << "apart is no hit";
        EXPECT_EQ(world.sweep(crate, {0, -1})->hit.fraction, 0) << "further in is";
    });
}

TEST(WorldSweep, FilterPicks) {
    World2 world;
    const Id ghost = world.add(unit, {.pose = place(4), .sensor = true}),
             other = world.add(unit, {.pose = place(8), .layers = 2}), last = world.add(unit, {.pose = place(12)});
    before_and_after_update(world, [&] {
        const auto first = [&](const Filter& filter) {
            const auto straight = world.sweep(unit, {20, 0}, filter);
            const auto turning = world.sweep(unit, place(0), {{20, 0}, {0, 1}}, filter);
            EXPECT_EQ(straight ? straight->id : Id{}, turning ? turning->id : Id{});
            return straight ? straight->id : Id{};
        };
        EXPECT_EQ(first({}), other);
        EXPECT_EQ(first({.sensors = true}), ghost);
        EXPECT_EQ(first({.mask = 1}), last);
        EXPECT_EQ(first({.ignore = other}), last);
        EXPECT_EQ(first({.mask = 4}), Id{});
    });
}

TEST(WorldSweep, HalfSpacesHaveNoBounds) {
    World2 world;
    const Id ground = world.add(HalfSpace2{{0, 1}, 0}, {.fixed = true}), ball = world.add(unit, {.pose = place(0, 5)});
    before_and_after_update(world, [&] {
        const auto down = world.sweep(Circle{{1e5f, 3}, 1}, {0, -4});
        ASSERT_TRUE(down);
        EXPECT_EQ(down->id, ground);
        EXPECT_NEAR(down->hit.fraction, 0.5f, 1e-2f);
        const auto ceiling = world.sweep(HalfSpace2{{0, -1}, -10}, {0, -8});
        ASSERT_TRUE(ceiling);
        EXPECT_EQ(ceiling->id, ball);
        EXPECT_NEAR(ceiling->hit.fraction, 0.5f, 1e-5f);
        const auto turned = world.sweep(HalfSpace2{{0, -1}, -10}, place(0), {{0, -8}, Turn::by(0.01f)});
        ASSERT_TRUE(turned);
        EXPECT_EQ(turned->id, ball);
    });
}

TEST(WorldSweep, NothingIsTooThinOrTooFast) {
    for (const BroadPhaseKind kind : all_kinds) {
        SCOPED_TRACE(static_cast<int>(kind));
        World3 world({.broad_phase = kind});
        oracle::Random random(31);
        const Id wall = world.add(Box3{{0, 0, 0}, {0.5e-3f, 50, 50}}, {.fixed = true});
        for (int i = 0; i < 50; ++i)  // beside the path
            world.add(Sphere{{0, 0, 0}, 1}, {.pose = {to_float(random.in_cube<3>() * 40.0) + Vec3(0, 0, 60)}});
        world.update();
        for (int i = 0; i < 200; ++i) {
            const float size = random.uniform_float(1e-3, 1e-2);
            const Vec3 from(random.uniform_float(-90, -1) * size * 100, random.uniform_float(-20, 20), 0);
            const Vec3 motion(1e4f * size, random.uniform_float(-10, 10), random.uniform_float(-10, 10));
            if (from.x + motion.x < 1) continue;
            const auto hit = world.sweep(Sphere{from, 0.5f * size}, motion);
            ASSERT_TRUE(hit) << i;
            ASSERT_EQ(hit->id, wall);
            ASSERT_NEAR(static_cast<double>(from.x + hit->hit.fraction * motion.x + 0.5f * size), -0.5e-3, 2e-5) << i;
            const Box3 bullet{{0, 0, 0}, Vec3(0.5f * size)};
            const auto turning = world.sweep(bullet, Motion3{{from}, motion, {3, 40, 1}});
            ASSERT_TRUE(turning) << i;
            ASSERT_EQ(turning->id, wall);
        }
    }
}

template <int D>
Bits record(BroadPhaseKind kind) {
    Bits said;
    World<D> world({.ball_early_out = BallEarlyOut::never, .broad_phase = kind});
    oracle::Random random(51);
    constexpr double extent = D == 2 ? 25 : 10;
    int hits = 0;
    for (int i = 0; i < 300; ++i)
        with_random_shape<D>(random, random_kind<D>(random, 0.01), [&](const auto& shape) {
            world.add(shape, {.pose = random_pose<D>(random, extent), .fixed = i % 4 == 0});
        });
    world.update();
    for (int i = 0; i < 150; ++i)
        with_random_shape<D>(random, random_kind<D>(random, 0), [&](const auto& shape) {
            const Pose<D> from = random_pose<D>(random, extent), to = random_pose<D>(random, extent);
            const auto straight = world.sweep(at(shape, from), to.position - from.position);
            const auto turning = world.sweep(shape, from, to);
            said.put(straight);
            said.put(turning);
            hits += (straight ? 1 : 0) + (turning ? 1 : 0);
        });
    EXPECT_GT(hits, 60);
    return said;
}

TEST(WorldSweep, AnswersTheSameWhateverTheBroadPhase) {
    for (const BroadPhaseKind kind : all_kinds) {
        EXPECT_TRUE(record<2>(kind) == record<2>(BroadPhaseKind::brute_force)) << static_cast<int>(kind);
        EXPECT_TRUE(record<3>(kind) == record<3>(BroadPhaseKind::brute_force)) << static_cast<int>(kind);
    }
}

/// Rough ground from x = -20 to 20, with a level middle part.
std::vector<Vec2> rough_ground(oracle::Random& random) {
    std::vector<Vec2> result;
    for (int x = -20; x <= 20; ++x)
        result.emplace_back(static_cast<float>(x), std::abs(x) < 5 ? 0.0f : random.uniform_float(-0.5, 0.5));
    return result;
}

TEST(WorldSweep, AtOneChainIsThatOfTheChain) {
    oracle::Random random(61);
    int hits = 0;
    constexpr int count = 3000;
    const Chain chain = *Chain::build(rough_ground(random), false);
    World2 world;
    world.add(chain, {.fixed = true});
    for (int i = 0; i < count; ++i) {
        Box2 box{{random.uniform_float(-20, 20), random.uniform_float(-0.2, 2)}, Vec2(0.3f)};
        Vec2 motion{random.uniform_float(-2, 2), random.uniform_float(-2, 0)};
        if (i % 2 == 0) {
            // It slides over the seams of the level part, and its corner sinks to an end of a segment.
            box.center = {random.uniform_float(-4, 4), 0.3f};
            motion.y = random.uniform_float(-5e-6, 0);
        }
        const auto expected = sweep(box, motion, chain);
        const auto hit = world.sweep(box, motion);
        ASSERT_EQ(hit.has_value(), expected.has_value());
        if (!hit) continue;
        ++hits;
        ASSERT_TRUE(Bits(hit->hit) == Bits(*expected)) << "box at " << box.center.x << ", " << box.center.y;
    }
    EXPECT_GT(hits, count / 3);
    EXPECT_LT(hits, count - count / 10);
}

TEST(WorldSweep, HasNoNormalOfTheSeamOfTwoChains) {
    std::vector<Vec2> left, right;
    for (int x = 0; x <= 20; ++x) {
        left.emplace_back(static_cast<float>(x - 20), 0.0f);
        right.emplace_back(static_cast<float>(x), 0.0f);
    }
    const Chain beyond = *Chain::build(right, false);
    World2 world;
    world.add(*Chain::build(left, false), {.fixed = true});
    const Id hit_one = world.add(beyond, {.fixed = true});
    // Its lower right corner sinks by 3e-6 on the way to the end of the other chain.
    const Box2 box{{-0.540712774f, 0.300000012f}, Vec2(0.3f)};
    const Vec2 motion{0.364902914f, -3.14491626e-06f};
    const auto alone = sweep(box, motion, beyond);
    ASSERT_TRUE(alone);
    ASSERT_LT(alone->normal.x, -0.99f) << "without the other chain it is an end";
    before_and_after_update(world, [&] {
        const auto hit = world.sweep(box, motion);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->id, hit_one);
        EXPECT_GT(hit->hit.normal.y, 0.999f);
    });
}

}  // namespace
}  // namespace abut::test
