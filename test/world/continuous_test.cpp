// Continuous collision detection between two updates: closed-form examples, and motions sampled in fine steps.

#include "../broad_phase/allocations.hpp"
#include "support/bits.hpp"
#include "support/circles.hpp"
#include "support/random_shapes.hpp"
#include <abut/math/motion.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <array>
#include <iostream>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

/// Updates the world and compares the lists; returns the fractions.
std::vector<float> expect_update(World2& world, const Pairs& began, const Pairs& stayed, const Pairs& ended) {
    const Events events = world.update();
    EXPECT_EQ(list(events.began), began);
    EXPECT_EQ(list(events.stayed), stayed);
    EXPECT_EQ(list(events.ended), ended);
    EXPECT_EQ(events.fractions.size(), events.began.size());
    return {events.fractions.begin(), events.fractions.end()};
}

const Circle small{{0, 0}, 0.5f};
const Box2 thin{{0, 0}, {0.0005f, 10}};

TEST(Continuous, BulletThatPassedAWallBeganAndEnds) {
    World2 world;
    const Id wall = world.add(thin, {.fixed = true}),
             bullet = world.add(small, {.pose = place(-10), .continuous = true}),
             slow = world.add(small, {.pose = place(-10, 3)});
    const Pairs pair{{wall, bullet}};
    expect_update(world, {}, {}, {});
    world.move(bullet, place(10));
    world.move(slow, place(10, 3));
    const std::vector<float> fractions = expect_update(world, pair, {}, {});
    ASSERT_EQ(fractions.size(), 1u);
    EXPECT_NEAR(fractions[0], (9.5f - 0.0005f) / 20, 1e-6f);
    EXPECT_TRUE(world.contacts().empty());
    expect_update(world, {}, {}, pair);
    expect_update(world, {}, {}, {});
    EXPECT_EQ(world.counts().near, 0u) << "its box is no longer the swept AABB";
}

TEST(Continuous, EachPassIsReported) {
    World2 world;
    const Id wall = world.add(thin, {.fixed = true}),
             bullet = world.add(small, {.pose = place(-10), .continuous = true});
    const Pairs pair{{wall, bullet}};
    world.update();
    world.move(bullet, place(10));
    expect_update(world, pair, {}, {});
    world.move(bullet, place(-10));
    expect_update(world, pair, {}, pair);
    world.move(bullet, place(0.4f));
    EXPECT_LT(expect_update(world, pair, {}, pair).at(0), 1);
    EXPECT_EQ(world.contacts().size(), 1u);
    world.move(bullet, place(-0.4f));
    expect_update(world, {}, pair, {});
    world.move(bullet, place(-10));
    expect_update(world, {}, {}, pair);
}

TEST(Continuous, TouchingPairsHaveTheirTimeOfImpact) {
    World2 world;
    const Id wall = world.add(Box2{{0, 0}, {1, 1}}, {.fixed = true}),
             bullet = world.add(small, {.pose = place(-5.5f), .continuous = true}),
             other = world.add(small, {.pose = place(0, 6)});
    world.update();
    world.move(bullet, place(-1.5f + 1));
    world.move(other, place(0, 0.2f));
    const std::vector<float> fractions = expect_update(world, {{wall, bullet}, {wall, other}, {bullet, other}}, {}, {});
    EXPECT_NEAR(fractions.at(0), 4.0f / 5, 1e-6f);
    EXPECT_EQ(fractions.at(1), 1) << "neither is continuous";
    EXPECT_LT(fractions.at(2), 1) << "one is";
    EXPECT_EQ(world.contacts().size(), 3u);
}

TEST(Continuous, ItemsThatChangePlacesTouchHalfway) {
    World2 world;
    const Id a = world.add(small, {.pose = place(-4), .continuous = true}), b = world.add(small, {.pose = place(4)});
    world.update();
    world.move(a, place(4));
    world.move(b, place(-4));
    const std::vector<float> fractions = expect_update(world, {{a, b}}, {}, {});
    EXPECT_NEAR(fractions.at(0), 7.0f / 16, 1e-6f);
    // The items stay side by side, although their paths cross.
    world.move(a, place(4, 20));
    world.move(b, place(-4, 20));
    expect_update(world, {}, {}, {{a, b}});
    world.move(a, place(-4, 0));
    world.move(b, place(-12, 0));
    expect_update(world, {}, {}, {});
}

TEST(Continuous, MovingItemsHitRestingOnes) {
    World2 world;
    const Id sensor = world.add(small, {.sensor = true, .continuous = true}),
             mover = world.add(small, {.pose = place(-4)}), door = world.add(thin, {.pose = place(30), .fixed = true});
    world.update();
    world.move(mover, place(4));
    EXPECT_NEAR(expect_update(world, {{sensor, mover}}, {}, {}).at(0), 3.0f / 8, 1e-6f);
    world.move(door, place(-30));
    EXPECT_NEAR(expect_update(world, {{sensor, door}}, {}, {{sensor, mover}}).at(0), 29.5f / 60, 1e-4f);
    EXPECT_TRUE(world.contacts().empty());
    expect_update(world, {}, {}, {{sensor, door}});
}

TEST(Continuous, RotatingRodHitsWhatItSweepsOver) {
    World2 world;
    const Id post = world.add(Circle{{0, 3}, 0.1f}, {.fixed = true}),
             rod = world.add(Capsule2{{-4, 0}, {4, 0}, 0.05f}, {.continuous = true});
    world.add(Circle{{0, 4.2f}, 0.1f}, {.fixed = true});
    world.update();
    world.move(rod, {{0, 0}, Turn::by(3)});
    const float fraction = expect_update(world, {{post, rod}}, {}, {}).at(0);
    EXPECT_GT(fraction, (1.5707f - 0.06f) / 3);
    EXPECT_LT(fraction, (1.5707f - 0.04f) / 3);
    expect_update(world, {}, {}, {{post, rod}});
}

TEST(Continuous, FilterHolds) {
    World2 world;
    const Id wall = world.add(thin, {.layers = 2, .fixed = true}),
             bullet = world.add(small, {.pose = place(-10), .mask = 1, .fixed = true, .continuous = true});
    world.update();
    world.move(bullet, place(10));
    expect_update(world, {}, {}, {});
    world.set_filter(bullet, 1, 3);
    world.move(bullet, place(-10));
    expect_update(world, {}, {}, {});
    EXPECT_EQ(world.counts().near, 0u) << "both are fixed";
    const Id other = world.add(small, {.pose = place(-10, 5), .mask = 1, .continuous = true});
    world.update();
    world.move(other, place(10, 5));
    expect_update(world, {}, {}, {});
    world.set_filter(other, 1, 2);
    world.move(other, place(-10, 5));
    expect_update(world, {{wall, other}}, {}, {});
}

TEST(Continuous, WhatIsNewOrChangedHasNoMotion) {
    World2 world;
    const Id wall = world.add(thin, {.fixed = true}),
             bullet = world.add(small, {.pose = place(-10), .continuous = true});
    world.move(bullet, place(10));
    expect_update(world, {}, {}, {});
    world.move(bullet, place(-10));
    world.set_shape(bullet, Circle{{0, 0}, 0.4f});
    expect_update(world, {}, {}, {});
    world.set_shape(bullet, small);
    world.move(bullet, place(10));
    expect_update(world, {}, {}, {});
    // A new item in the same slot has no motion.
    world.move(bullet, place(-10));
    world.remove(bullet);
    const Id next = world.add(small, {.pose = place(-10), .continuous = true});
    EXPECT_EQ(next.index, bullet.index);
    expect_update(world, {}, {}, {});
    // An item that was moved several times moves linearly from the first pose to the last.
    world.move(next, place(10));
    world.move(next, place(-11));
    expect_update(world, {}, {}, {});
    world.move(next, place(-10));
    world.move(next, place(10));
    expect_update(world, {{wall, next}}, {}, {});
    world.remove(next);
    expect_update(world, {}, {}, {{wall, next}});
}

TEST(Continuous, HitsAThinWallAtTenThousandTimesItsSizeAStep) {
    for (const double size : {1e-3, 1.0, 1e3}) {
        SCOPED_TRACE(size);
        World3 world;
        const auto length = [&](double of_size) { return static_cast<float>(of_size * size); };
        const Id wall = world.add(Box3{{0, 0, 0}, {length(0.0005), length(5000), length(5000)}}, {.fixed = true});
        const Id bullet =
            world.add(Box3{{0, 0, 0}, Vec3(length(0.5))}, {.pose = {{length(-3000), 0, 0}}, .continuous = true});
        world.update();
        for (int i = 0; i < 100; ++i) {
            const float side = i % 2 == 0 ? 1.0f : -1.0f, turn = 0.1f * static_cast<float>(i % 3);
            const Vec3 to(side * length(3000 + 70 * i), length(13 * i), 0);
            world.move(bullet, {to, turn_about({0, 0.6f, 0.8f}, turn)});
            const Events events = world.update();
            ASSERT_EQ(list(events.began), (Pairs{{wall, bullet}})) << i;
            ASSERT_GT(events.fractions[0], 0.4f);
            ASSERT_LT(events.fractions[0], 0.6f);
        }
    }
}

/// A moved item with its previous pose.
template <int D>
struct Mover {
    Id id;
    View<D> own;
    bool continuous = false;
    Pose<D> from{}, to{};

    View<D> at(float time) const {
        if (time == 1) return moved(own, affine(to));
        return moved(own, affine(pose_at(Motion<D>::between(from, to), time)));
    }
};

/// Tests a few fast shapes: no pair that overlaps at some time is missed or reported late, and no reported pair is far
/// apart at its time of impact.
template <int D>
void follow_in_fine_steps(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    oracle::Random random(seed);
    constexpr int steps = 64;
    constexpr double extent = D == 2 ? 4 : 1.8;
    int passed = 0, touching = 0, none = 0;
    for (int round = 0; round < 20; ++round) {
        World<D> world;
        std::vector<Mover<D>> movers;
        for (int i = 0; i < 8; ++i) {
            const Pose<D> pose = random_pose<D>(random, extent);
            const bool continuous = i % 2 == 0;
            with_random_shape<D>(random, random_kind<D>(random, 0), [&](const auto& shape) {
                const Id id = world.add(shape, {.continuous = continuous});
                movers.push_back({id, world.shape(id), continuous, pose, pose});
                world.move(id, pose);
            });
        }
        world.update();
        for (int frame = 0; frame < 4; ++frame) {
            SCOPED_TRACE("round " + std::to_string(round) + ", frame " + std::to_string(frame));
            for (Mover<D>& mover : movers) {
                mover.from = mover.to;
                if (random.chance(0.8)) mover.to = random_pose<D>(random, extent);
                world.move(mover.id, mover.to);
            }
            const Events events = world.update();
            for (std::size_t i = 0; i < movers.size(); ++i)
                for (std::size_t j = i + 1; j < movers.size(); ++j) {
                    const Mover<D>&a = movers[i], &b = movers[j];
                    if ((!a.continuous && !b.continuous) || overlaps(a.at(0), b.at(0))) continue;
                    int first = 0;
                    while (first <= steps &&
                           !overlaps(a.at(static_cast<float>(first) / steps), b.at(static_cast<float>(first) / steps)))
                        ++first;
                    const IdPair pair{a.id, b.id};
                    const auto began = std::find(events.began.begin(), events.began.end(), pair);
                    if (began == events.began.end()) {
                        ASSERT_GT(first, steps) << "missed";
                        ++none;
                        continue;
                    }
                    const float fraction = events.fractions[static_cast<std::size_t>(began - events.began.begin())];
                    ASSERT_LE(fraction, (static_cast<float>(first) + 0.001f) / steps) << "late";
                    ASSERT_NEAR(closest(a.at(fraction), b.at(fraction)).distance, 0, 3e-5f);
                    ++(overlaps(a.at(1), b.at(1)) ? touching : passed);
                }
        }
    }
    std::cout << "seed " << seed << ": passed " << passed << ", touching " << touching << ", none " << none << "\n";
    EXPECT_GT(passed, 50);
    EXPECT_GT(touching, 10);
    EXPECT_GT(none, 50);
}

TEST(Continuous, MissesNothingThatFineStepsFind) {
    follow_in_fine_steps<2>(61);
    follow_in_fine_steps<3>(62);
}

/// Records all answers of a world of many items, some of them fast; `more` adds items.
template <int D, class More>
Bits record(const WorldOptions& options, double continuous, bool fractions, More&& more) {
    Bits said;
    oracle::Random random(71);
    World<D> world(options);
    std::vector<Id> ids;
    constexpr double extent = D == 2 ? 25 : 9;
    for (int i = 0; i < 200; ++i) {
        const bool fixed = random.chance(0.3), some = random.chance(continuous);
        with_random_shape<D>(random, random_kind<D>(random, 0.01), [&](const auto& shape) {
            const Pose<D> pose = random_pose<D>(random, extent);
            ids.push_back(world.add(shape, {.pose = pose, .fixed = fixed, .continuous = some}));
        });
    }
    more(world);
    std::size_t pairs = 0, on_the_way = 0;
    for (int frame = 0; frame < 25; ++frame) {
        for (const Id id : ids)
            if (random.chance(0.4))
                world.move(id, moved_a_little(random, world.pose(id), random.chance(0.1) ? 8 : 0.2));
        const Events events = world.update();
        said.put(events.began);
        said.put(events.stayed);
        said.put(events.ended);
        said.put(world.contacts());
        if (fractions) said.put(events.fractions);
        pairs += events.began.size() + events.stayed.size();
        for (const float fraction : events.fractions) on_the_way += fraction < 1 ? 1 : 0;
        const Vec<D> from = to_float(random.in_cube<D>() * extent), to = to_float(random.in_cube<D>() * extent);
        said.put(world.raycast(Ray<D>::between(from, to)));
        said.put(world.sweep(Ball<D>{from, 0.5f}, to - from));
        said.put(world.closest(from));
        said.put(world.overlapping(Ball<D>{to, 1}));
    }
    EXPECT_GT(pairs, 50u);
    EXPECT_EQ(on_the_way > 10, continuous > 0);
    return said;
}

TEST(Continuous, AnswersAreTheSameWhateverTheBroadPhase) {
    const auto nothing = [](auto&) {};
    const Bits expected2 = record<2>({.ball_early_out = BallEarlyOut::never}, 0.3, true, nothing),
               expected3 = record<3>({.ball_early_out = BallEarlyOut::always}, 0.3, true, nothing);
    for (const BroadPhaseKind kind : {BroadPhaseKind::brute_force, BroadPhaseKind::grid, BroadPhaseKind::layered_grid,
                                      BroadPhaseKind::sweep_and_prune, BroadPhaseKind::bvh, BroadPhaseKind::bsp}) {
        EXPECT_TRUE(record<2>({.broad_phase = kind}, 0.3, true, nothing) == expected2) << static_cast<int>(kind);
        EXPECT_TRUE(record<3>({.broad_phase = kind}, 0.3, true, nothing) == expected3) << static_cast<int>(kind);
    }
}

// One continuous item widens the boxes of all moving items, but changes no answer about the others.
TEST(Continuous, ChangesNothingAmongTheOthers) {
    const auto nothing = [](auto&) {};
    EXPECT_TRUE(record<2>({}, 0, true, nothing) == record<2>({}, 0, true, [](World2& world) {
                    world.add(small, {.pose = place(1000), .layers = 0, .continuous = true});
                }));
    EXPECT_TRUE(record<3>({}, 0, true, nothing) == record<3>({}, 0, true, [](World3& world) {
                    world.add(Sphere{{1000, 0, 0}, 1}, {.mask = 0, .continuous = true});
                }));
}

TEST(Continuous, UpdateAllocatesNothingOnceWarm) {
    World2 world({.broad_phase = BroadPhaseKind::bvh});
    std::vector<Id> ids;
    for (int i = 0; i < 40; ++i)
        ids.push_back(world.add(small, {.pose = place(2 * static_cast<float>(i)), .continuous = i % 2 == 0}));
    const Id wall = world.add(Box2{{0, 5}, {100, 0.001f}}, {.fixed = true});
    EXPECT_TRUE(world.contains(wall));
    std::size_t max_began = 0, last = 1;
    const auto lap = [&] {
        const std::size_t before = allocations();
        for (int frame = 0; frame < 6; ++frame) {
            for (std::size_t i = 0; i < ids.size(); ++i)
                world.move(ids[i], place(2 * static_cast<float>(i * (frame % 3 == 0 ? 0 : 1)), frame % 2 == 0 ? 9 : 0));
            max_began = std::max(max_began, world.update().began.size());
        }
        last = allocations() - before;
    };
    lap();
    EXPECT_GT(last, 0u);
    EXPECT_GT(max_began, 700u);
    lap();
    EXPECT_EQ(last, 0u);
    lap();
    EXPECT_EQ(last, 0u);
}

}  // namespace
}  // namespace abut::test
