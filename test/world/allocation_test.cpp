// Allocations: none in an update of a world that has seen a scene of this size, and none in queries without a list.

#include "../broad_phase/allocations.hpp"
#include "support/simulation.hpp"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class F>
std::size_t allocations_of(F&& work) {
    const std::size_t before = allocations();
    work();
    return allocations() - before;
}

TEST(Allocation, IsCounted) {
    EXPECT_EQ(allocations_of([] { std::vector<int>(1).resize(1000); }), 2u);
    World2 world;
    EXPECT_GT(allocations_of([&] { world.add(Circle{{0, 0}, 1}); }), 0u);
    EXPECT_GT(allocations_of([&] { world.update(); }), 0u);
}

/// A closed path of poses for every item, with a few pauses.
template <int D>
std::vector<std::vector<std::pair<Id, Pose<D>>>> lap(Simulation<D>& game, int frames) {
    std::vector<std::vector<std::pair<Id, Pose<D>>>> result(static_cast<std::size_t>(frames));
    for (auto& moves : result)
        for (const auto& [id, item] : game.reference.items())
            if (game.random().chance(item.options.fixed ? 0.01 : 0.6)) moves.emplace_back(id, game.any_pose());
    return result;
}

template <int D>
void expect_later_laps_allocate_nothing(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation<D> game(seed, 60);
    const auto moves = lap<D>(game, 51);
    const auto run_a_lap = [&] {
        std::size_t result = 0;
        std::size_t max_contacts = 0;
        for (const auto& frame : moves) {
            for (const auto& [id, pose] : frame) game.world.move(id, pose);
            result += allocations_of([&] { game.world.update(); });
            max_contacts = std::max(max_contacts, game.world.contacts().size());
        }
        EXPECT_GT(max_contacts, 10u);
        return result;
    };
    EXPECT_GT(run_a_lap(), 0u);
    EXPECT_EQ(run_a_lap(), 0u);
    EXPECT_EQ(run_a_lap(), 0u);
}

TEST(Allocation, UpdateAllocatesNothingOnceWarm) {
    expect_later_laps_allocate_nothing<2>(1);
    expect_later_laps_allocate_nothing<3>(2);
}

// Regression: each list of events grew when it was first long, and so did both lists of a swapped pair.
TEST(Allocation, OneUpdateOfThisSizeIsEnough) {
    World2 world;
    std::vector<Id> ids;
    for (int i = 0; i < 40; ++i) ids.push_back(world.add(Circle{{0, 0}, 1}, {.fixed = i % 4 == 0}));
    world.update();
    const std::size_t pairs = world.contacts().size();
    EXPECT_GT(pairs, 700u);
    const auto update = [&] { return allocations_of([&] { world.update(); }); };
    const auto move_all = [&](bool apart) {
        for (std::size_t i = 0; i < ids.size(); ++i) world.move(ids[i], {{apart ? 3 * static_cast<float>(i) : 0, 0}});
    };
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(update(), 0u) << "all stay";
        move_all(true);
        EXPECT_EQ(update(), 0u) << "all end";
        EXPECT_TRUE(world.contacts().empty());
        move_all(false);
        EXPECT_EQ(update(), 0u) << "all begin";
        EXPECT_EQ(world.contacts().size(), pairs);
        // New items take the same slots.
        for (Id& id : ids) {
            world.remove(id);
            id = world.add(Box2{{0, 0}, {1, 1}}, {.fixed = id.index % 4 == 0});
        }
        EXPECT_EQ(update(), 0u) << "all end, and as many begin";
    }
}

template <int D>
void expect_queries_allocate_nothing(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation<D> game(seed, 60);
    int found = 0, touching = 0;
    std::array<WorldClosest<D>, 5> nearest;
    for (int i = 0; i < 200; ++i) {
        if (i == 100) game.world.update();
        const Vec<D> from = game.any_point(), to = game.any_point();
        const Ray<D> ray = Ray<D>::between(from, to);
        game.with_any_shape([&](const auto& shape) {
            const Pose<D> there = random_pose<D>(game.random(), Simulation<D>::extent);
            const auto placed = at(shape, there);
            EXPECT_EQ(allocations_of([&] {
                          found += game.world.raycast(ray) ? 1 : 0;
                          found += game.world.raycast_any(ray) ? 1 : 0;
                          found += game.world.sweep(placed, to - from) ? 1 : 0;
                          found += game.world.sweep(shape, there, {to, there.rotation}) ? 1 : 0;
                          found += game.world.sweep(shape, Motion<D>::between(there, {from})) ? 1 : 0;
                          found += game.world.closest(placed) ? 1 : 0;
                          found += game.world.closest(from) ? 1 : 0;
                          found += static_cast<int>(game.world.k_nearest(placed, nearest));
                          found += static_cast<int>(game.world.k_nearest(from, nearest));
                          game.world.each_overlapping(placed, [&](Id) { ++found; });
                          game.world.each_item([&](Id id) {
                              game.world.each_touching(id, [&](Id other) {
                                  ++touching;
                                  const IdPair pair{std::min(id, other), std::max(id, other)};
                                  found += game.world.contact(pair) ? 1 : 0;
                                  found += game.world.impact(pair) ? 1 : 0;
                              });
                          });
                      }),
                      0u);
        });
    }
    EXPECT_GT(found, 600);
    EXPECT_GT(touching, 600);
}

TEST(Allocation, QueriesThatReturnNoListAllocateNothing) {
    expect_queries_allocate_nothing<2>(3);
    expect_queries_allocate_nothing<3>(4);
}

}  // namespace
}  // namespace abut::test
