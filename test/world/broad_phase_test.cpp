// The broad phase that a world chooses, on which no answer depends.

#include "support/bits.hpp"
#include "support/simulation.hpp"
#include <abut/world/detail/query_count.hpp>

#include <algorithm>
#include <array>
#include <thread>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

constexpr std::array all_kinds{BroadPhaseKind::brute_force,     BroadPhaseKind::grid, BroadPhaseKind::layered_grid,
                               BroadPhaseKind::sweep_and_prune, BroadPhaseKind::bvh,  BroadPhaseKind::bsp};

/// A game that starts small, grows, sends many queries for a while and then none; it records all answers of its world.
template <int D>
struct Script {
    explicit Script(const WorldOptions& options) : world(options) {
        play(10, 20, 0);
        play(30, 220, 0);
        play(30, 220, 60);
        play(140, 220, 0);
        EXPECT_GT(pairs, 10000u);
    }

    void play(int frames, std::size_t items, int count) {
        for (int frame = 0; frame < frames; ++frame) {
            while (ids.size() < items) add();
            for (const Id id : ids)
                if (random.chance(0.4)) world.move(id, moved_a_little(random, world.pose(id), 0.2));
            // The next item of this slot may be fixed if this one was not.
            std::swap(ids[random.below(static_cast<std::uint32_t>(ids.size()))], ids.back());
            world.remove(ids.back());
            ids.pop_back();
            add();
            run_queries(count);
            update();
        }
        kinds.push_back(world.broad_phase());
    }
    void add() {
        const Pose<D> pose = random_pose<D>(random, extent);
        const bool fixed = random.chance(0.2);
        with_random_shape<D>(random, random_kind<D>(random), [&](const auto& shape) {
            ids.push_back(world.add(shape, {.pose = pose, .fixed = fixed}));
        });
    }
    void run_queries(int count) {
        for (int i = 0; i < count; ++i) {
            const Vec<D> from = to_float(random.in_cube<D>() * extent), to = to_float(random.in_cube<D>() * extent);
            said.put(world.raycast(Ray<D>::between(from, to)));
            said.put(world.raycast_all(Ray<D>::between(from, to)));
            said.put(world.closest(from));
            said.put(world.overlapping(Ball<D>{to, 1}));
            said.put(world.containing(to));
        }
    }
    void update() {
        const Events events = world.update();
        said.put(events.began);
        said.put(events.stayed);
        said.put(events.ended);
        said.put(world.contacts());
        pairs += world.counts().near;
    }

    static constexpr double extent = D == 2 ? 12 : 5;
    oracle::Random random{D};
    World<D> world;
    std::vector<Id> ids;
    Bits said;
    std::vector<BroadPhaseKind> kinds;  ///< the broad phase after each part of the game
    std::size_t pairs = 0;
};

template <int D>
void expect_same_answers_whatever_is_chosen() {
    const Script<D> chosen({.ball_early_out = BallEarlyOut::never});
    EXPECT_EQ(chosen.kinds, (std::vector{BroadPhaseKind::brute_force, BroadPhaseKind::grid, BroadPhaseKind::bvh,
                                         BroadPhaseKind::grid}));
    for (const BroadPhaseKind kind : all_kinds) {
        const Script<D> forced({.ball_early_out = BallEarlyOut::never, .broad_phase = kind});
        EXPECT_EQ(forced.kinds, std::vector(4, kind));
        EXPECT_TRUE(forced.said == chosen.said) << static_cast<int>(kind);
    }
}

TEST(BroadPhaseOfAWorld, ChangesNoAnswer) {
    expect_same_answers_whatever_is_chosen<2>();
    expect_same_answers_whatever_is_chosen<3>();
}

/// Moves balls in circles, with `rays` raycasts before every `every`-th update.
int changes_of_kind(int rays, int every, int frames, BroadPhaseKind last) {
    World2 world;
    std::vector<Id> ids;
    for (int i = 0; i < 400; ++i) {
        const Vec2 place(static_cast<float>(i % 20), static_cast<float>(i / 20));
        ids.push_back(world.add(Circle{{0, 0}, 0.6f}, {.pose = {3.0f * place}}));
    }
    int changes = 0;
    BroadPhaseKind before = BroadPhaseKind::grid;
    for (int frame = 0; frame < frames; ++frame) {
        for (const Id id : ids) {
            const Vec2 place = world.pose(id).position;
            world.move(id, {place + Vec2(frame % 2 == 0 ? 0.5f : -0.5f, 0)});
        }
        for (int i = 0; i < rays && frame % every == 0; ++i)
            world.raycast(Ray2::between({0, static_cast<float>(i)}, {60, static_cast<float>(i)}));
        world.update();
        changes += world.broad_phase() != before ? 1 : 0;
        before = world.broad_phase();
    }
    EXPECT_EQ(before, last) << rays << " rays every " << every;
    return changes;
}

TEST(BroadPhaseOfAWorld, IsStableWithOccasionalRays) {
    EXPECT_EQ(changes_of_kind(0, 1, 300, BroadPhaseKind::grid), 0);
    EXPECT_EQ(changes_of_kind(1, 10, 300, BroadPhaseKind::grid), 0);
    EXPECT_EQ(changes_of_kind(120, 1, 300, BroadPhaseKind::bvh), 1);
    EXPECT_EQ(changes_of_kind(120, 2, 300, BroadPhaseKind::bvh), 1);
    EXPECT_EQ(changes_of_kind(120, 4, 300, BroadPhaseKind::bvh), 1);
}

// Regression: the choice for a growing world counted no query before the first update.
TEST(BroadPhaseOfAWorld, SuitsQueriesBeforeTheFirstUpdate) {
    for (const bool queries : {false, true}) {
        World2 world;
        for (int i = 0; i < 1000; ++i) {
            world.add(Circle{{static_cast<float>(i % 32), static_cast<float>(i) / 32}, 0.4f});
            if (queries) world.raycast(Ray2{{-1, 0}, {1, 0}, 100});
        }
        EXPECT_EQ(world.broad_phase(), queries ? BroadPhaseKind::bvh : BroadPhaseKind::grid);
    }
}

TEST(QueryCount, IsTheSameFromManyThreads) {
    detail::QueryCount count;
    EXPECT_EQ(count.take(1000), 0u);
    const auto add_from_threads = [&](int times) {
        std::vector<std::thread> threads;
        for (int i = 0; i < 4; ++i)
            threads.emplace_back([&count, times] {
                for (int k = 0; k < times; ++k) count.add(detail::ray_weight);
            });
        for (std::thread& thread : threads) thread.join();
    };
    add_from_threads(20);
    EXPECT_EQ(count.take(1000), 4 * 20 * detail::ray_weight);
    add_from_threads(5000);
    EXPECT_EQ(count.take(77), 1000u);
    count.add(detail::region_weight);
    detail::QueryCount moved = std::move(count);
    EXPECT_EQ(moved.take(0), detail::region_weight);
    moved.add(detail::ray_weight);
    EXPECT_EQ(moved.take(0), 0u);
}

}  // namespace
}  // namespace abut::test
