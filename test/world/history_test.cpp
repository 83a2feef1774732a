// The past of a world is that of copies which were made at each tick, bit by bit.

#include "../broad_phase/allocations.hpp"
#include "support/bits.hpp"
#include "support/circles.hpp"
#include "support/simulation.hpp"
#include <abut/world/history.hpp>

#include <deque>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// The answers to random queries of every kind, and all that getters return.
template <int D>
Bits answers(const World<D>& world, Simulation<D>& game) {
    Bits result;
    world.each_item([&](Id id) {
        const ItemOptions<D> options = world.options(id);
        result.put(id);
        result.put(options.pose.position);
        for (const std::uint64_t word : {options.user, options.layers, options.mask}) {
            result.put(static_cast<std::uint32_t>(word));
            result.put(static_cast<std::uint32_t>(word >> 32));
        }
        for (const bool flag : {options.fixed, options.sensor, options.continuous, options.enabled}) result.put(flag);
        result.put(static_cast<std::uint32_t>(options.group));
    });
    result.put(static_cast<std::uint32_t>(world.size()));
    for (int i = 0; i < 4; ++i) {
        const Vec<D> from = game.any_point(), to = game.any_point();
        const Filter filter = game.filter();
        const Ray<D> ray = Ray<D>::between(from, to);
        result.put(world.raycast(ray, filter));
        result.put(world.raycast_any(ray, filter));
        result.put(world.raycast_all(ray, filter));
        result.put(world.containing(from, filter));
        result.put(world.closest(from, filter));
        result.put(world.k_nearest(to, 5, filter));
        game.with_any_shape([&](const auto& shape) {
            const Pose<D> there = game.any_pose();
            const auto placed = at(shape, there);
            result.put(world.sweep(placed, to - from, filter));
            result.put(world.sweep(shape, there, {to, there.rotation}, filter));
            result.put(world.closest(placed, filter));
            result.put(world.k_nearest(placed, 5, filter));
            result.put(world.overlapping(placed, filter));
            std::vector<WorldContact<D>> contacts;
            world.each_contact(
                placed,
                [&](Id id, const Contact<D>& contact) {
                    contacts.push_back({{}, id, contact});
                },
                filter);
            std::ranges::stable_sort(contacts, {}, &WorldContact<D>::b);
            result.put(contacts);
        });
    }
    return result;
}

/// The rebuilt world at a tick, with the items on their way to the next tick.
template <int D>
World<D> rebuilt(const World<D>& then, const World<D>& next, float fraction) {
    World<D> result = then;
    then.each_item([&](Id id) {
        if (fraction == 0 || !next.contains(id)) return;
        const Pose<D> from = then.pose(id), to = next.pose(id);
        if (fraction == 1)
            result.move(id, to);
        else if (from != to)
            result.move(id, pose_at(Motion<D>::between(from, to), fraction));
    });
    return result;
}

template <int D>
struct Played {
    Played(std::uint64_t seed, std::size_t limit)
        : ticks(limit), game(seed, 30, false, {}, 0.1), past(game.world, limit) {
        game.with_all = true;
    }

    void play() {
        // At times all is at rest, so that tracks end, and begin again.
        if (past.last_tick() / 16 % 2 == 0)
            game.change();
        else if (game.random().chance(0.3))
            game.move(game.any_id(), game.any_pose());
        if (game.random().chance(0.7)) game.world.update();
        EXPECT_EQ(past.record(), ++last);
        copies.push_back(game.world);
        if (copies.size() > ticks) copies.pop_front();
    }
    void expect_same(std::uint64_t tick, float fraction) {
        SCOPED_TRACE("tick " + std::to_string(tick) + " + " + std::to_string(fraction) + " of " + std::to_string(last));
        const std::size_t i = static_cast<std::size_t>(tick - past.first_tick());
        const World<D> expected = rebuilt(copies[i], copies[std::min(i + 1, copies.size() - 1)], fraction);
        Simulation<D> other = game;  // the same random queries
        EXPECT_TRUE(answers(past.at(tick, fraction), game) == answers(expected, other));
    }

    std::size_t ticks;
    Simulation<D> game;
    History<D> past;
    std::deque<World<D>> copies;
    std::uint64_t last = ~std::uint64_t{0};
};

template <int D>
void expect_past_as_copied(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Played<D> played(seed, std::array<std::size_t, 4>{1, 2, 7, 12}[seed % 4]);
    EXPECT_EQ(played.past.size(), 0u);
    EXPECT_FALSE(played.past.contains(0));
    for (int i = 0; i < 60; ++i) {
        played.play();
        const std::uint64_t first = played.past.first_tick(), last = played.past.last_tick();
        ASSERT_EQ(last, played.last);
        ASSERT_EQ(played.past.size(), played.copies.size());
        EXPECT_TRUE(played.past.contains(first) && played.past.contains(last));
        EXPECT_FALSE(played.past.contains(last + 1) || (first > 0 && played.past.contains(first - 1)));
        oracle::Random& random = played.game.random();
        for (int k = 0; k < 2; ++k) {
            const std::uint64_t tick = last - random.below(static_cast<std::uint32_t>(played.copies.size()));
            played.expect_same(tick, std::array<float, 3>{0, 1, random.uniform_float(0, 1)}[random.below(3)]);
        }
    }
    EXPECT_GT(played.game.reused, 3);
}

TEST(History, IsThatOfCopies) {
    for (std::uint64_t seed = 700; seed < 712; ++seed) {
        expect_past_as_copied<2>(seed);
        expect_past_as_copied<3>(seed);
    }
}

TEST(History, IsThatOfCopiesAfterACopyAndARollback) {
    for (std::uint64_t seed = 720; seed < 724; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Played<3> played(seed, 8);
        for (int i = 0; i < 10; ++i) played.play();
        const std::vector<std::byte> bytes = played.game.world.save();
        const ReferenceWorld<3> reference = played.game.reference;
        for (int i = 0; i < 3; ++i) played.play();
        ASSERT_FALSE(played.game.world.restore(bytes));
        played.game.reference = reference;
        for (int i = 0; i < 3; ++i) played.play();
        played.past = History<3>(played.past);
        for (int i = 0; i < 2; ++i) played.play();
        for (std::uint64_t tick = played.past.first_tick(); tick <= played.past.last_tick(); ++tick)
            played.expect_same(tick, 0.25f);
    }
}

/// A copy of the past is a world like any other: its update finds what a new world with these items finds.
template <int D>
void expect_copies_live_on(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Played<D> played(seed, 8);
    std::size_t contacts = 0;
    for (int i = 0; i < 30; ++i) {
        played.play();
        World<D> then = played.past.at(played.past.first_tick(), 0.5f);
        EXPECT_TRUE(then.contacts().empty());
        World<D> fresh;
        std::vector<Id> ids{Id{}};
        then.each_item([&](Id id) {
            ids.push_back(id);
            EXPECT_EQ(fresh.add(then.any_shape(id), then.options(id)).index + 1, ids.size());
        });
        const auto as_then = [&](const IdPair& pair) { return IdPair{ids[pair.a.index], ids[pair.b.index]}; };
        Bits found(then.update().began), expected;
        std::vector<IdPair> began;
        for (const IdPair& pair : fresh.update().began) began.push_back(as_then(pair));
        expected.put(began);
        for (const WorldContact<D>& each : then.contacts()) found.put(each);
        for (const WorldContact<D>& each : fresh.contacts()) {
            const IdPair pair = as_then({each.a, each.b});
            expected.put(WorldContact<D>{pair.a, pair.b, each.contact});
        }
        EXPECT_TRUE(found == expected);
        contacts += then.contacts().size();

        const std::vector<std::byte> bytes = then.save();
        const Id added = then.add(Ball<D>{});
        EXPECT_EQ(then.size(), ids.size());
        EXPECT_TRUE(then.contains(added));
        EXPECT_FALSE(then.restore(bytes));
        EXPECT_EQ(then.save(), bytes);
    }
    EXPECT_GT(contacts, 100u);
}

TEST(History, ItsCopiesLiveOn) {
    for (std::uint64_t seed = 730; seed < 734; ++seed) {
        expect_copies_live_on<2>(seed);
        expect_copies_live_on<3>(seed);
    }
}

const Ray2 along_the_row{{-10, 0}, {1, 0}, 100};

TEST(History, HoldsWhatWasRemovedAndNotWhatWasAdded) {
    World2 world;
    History2 past(world, 4);
    const Id removed = world.add(unit, {.pose = place(0), .user = 7});
    past.record();
    world.set_shape(removed, Circle{{0, 0}, 2});
    world.set_user(removed, 8);
    past.record();
    world.remove(removed);
    past.record();
    const Id added = world.add(Circle{{0, 0}, 3});
    past.record();
    EXPECT_EQ(added.index, removed.index);

    EXPECT_EQ(past.at(0).raycast(along_the_row)->hit.distance, 9);
    EXPECT_EQ(past.at(0, 0.5f).user(removed), 7u);
    EXPECT_FALSE(past.at(0).contains(added));
    EXPECT_EQ(past.at(1).raycast(along_the_row)->hit.distance, 8);
    EXPECT_EQ(past.at(1, 1).user(removed), 8u);
    EXPECT_FALSE(past.at(2).raycast(along_the_row));
    EXPECT_EQ(past.at(2, 0.5f).size(), 0u);
    EXPECT_EQ(past.at(3).raycast(along_the_row)->id, added);
    EXPECT_FALSE(past.at(3).contains(removed));
}

// Regression: the memory of what the past showed last held something else by then.
TEST(History, IsRightAfterTicksWithoutAQuestion) {
    for (std::uint64_t pause = 1; pause < 12; ++pause) {
        World2 world;
        History2 past(world, 2);
        const Id id = world.add(unit);
        for (std::uint64_t i = 0; i < 40; ++i) {
            world.set_user(id, i);
            past.record();
            if (i % pause != 0) continue;
            EXPECT_EQ(past.at(i).user(id), i) << pause;
        }
    }
}

TEST(History, IsWhereItsItemsWereBetweenTwoTicks) {
    World2 world;
    History2 past(world, 4);
    const Id id = world.add(unit, {.pose = place(0)});
    past.record();
    world.move(id, {{4, 0}, Turn::by(1)});
    past.record();
    EXPECT_EQ(past.at(0, 0.25f).pose(id).position, Vec2(1, 0));
    EXPECT_EQ(past.at(0, 0.25f).raycast(along_the_row)->hit.distance, 10);
    EXPECT_EQ(past.at(0, 0.25f).pose(id), pose_at(Motion2::between(place(0), world.pose(id)), 0.25f));
    EXPECT_EQ(past.at(0, 1).pose(id), world.pose(id));
    EXPECT_EQ(past.at(1, 0.5f).pose(id), world.pose(id)) << "nothing comes after the last tick";
}

TEST(History, LeavesItemsOnOtherLayersAsTheyAre) {
    constexpr std::uint64_t players = 2;
    World2 world;
    History2 past(world, 3, {.layers = players});
    const Id player = world.add(unit, {.pose = place(0), .layers = players | 4}),
             crate = world.add(unit, {.pose = place(10)}), removed = world.add(unit, {.pose = place(20)});
    past.record();
    world.move(player, place(1));
    world.move(crate, place(11));
    world.remove(removed);
    past.record();
    EXPECT_EQ(past.at(0).pose(player), place(0));
    EXPECT_EQ(past.at(0).pose(crate), place(11));
    EXPECT_FALSE(past.at(0).contains(removed));

    // A crate in the slot of a player who left is absent while he is there.
    world.remove(player);
    const Id later = world.add(unit, {.pose = place(30)});
    EXPECT_EQ(later.index, player.index);
    past.record();
    EXPECT_EQ(past.at(1).pose(player), place(1));
    EXPECT_FALSE(past.at(1).contains(later));
    EXPECT_EQ(past.at(2).pose(later), place(30));

    // Once no tick with the player is held, it is as at the last record.
    past.record();
    world.move(later, place(31));
    past.record();
    EXPECT_EQ(past.first_tick(), 2u);
    for (std::uint64_t tick = 2; tick <= 4; ++tick) EXPECT_EQ(past.at(tick).pose(later), place(31)) << tick;

    // An item that gets onto the layers was before as at the last record.
    world.set_filter(crate, players, players);
    world.move(crate, place(12));
    past.record();
    EXPECT_EQ(past.at(3).pose(crate), place(11));
    EXPECT_EQ(past.at(4).layers(crate), 1u);
    EXPECT_EQ(past.at(5).pose(crate), place(12));
}

TEST(History, AllocatesNothingOnceWarm) {
    World3 world;
    std::vector<Id> players;
    for (int i = 0; i < 200; ++i)
        world.add(Box3{{0, 0, 0}, {1, 1, 1}},
                  {.pose = {{3 * static_cast<float>(i % 20), 0, static_cast<float>(i)}}, .fixed = true});
    for (int i = 0; i < 16; ++i) players.push_back(world.add(Sphere{{0, 0, 0}, 1}));
    History3 past(world, 8);
    oracle::Random random(5);
    int hits = 0;
    const auto play = [&](int frames) {
        std::size_t result = 0;
        for (int frame = 0; frame < frames; ++frame) {
            // All move for a while, and then rest for longer than the history holds.
            for (const Id id : players)
                if (frame % 40 < 20) world.move(id, random_pose<3>(random, 5));
            const std::size_t before = allocations();
            world.update();
            const std::uint64_t last = past.record();
            for (int shot = 0; shot < 3; ++shot) {
                const std::uint64_t tick = last - random.below(static_cast<std::uint32_t>(past.size()));
                const World3& then = past.at(tick, random.uniform_float(0, 1));
                const Vec3 from = to_float(random.in_cube<3>() * 20.0), to = to_float(random.in_cube<3>() * 5.0);
                hits += then.raycast(Ray3::between(from, to)) ? 1 : 0;
            }
            result += allocations() - before;
            // An item that comes and goes.
            const Id id = players[random.below(16)];
            world.set_enabled(id, !world.is_enabled(id));
        }
        return result;
    };
    EXPECT_GT(play(400), 0u);
    EXPECT_EQ(play(400), 0u);
    EXPECT_GT(hits, 300);
    EXPECT_LT(hits, 2100);
}

TEST(History, TakesMemoryForTicksOnlyWhereItemsMove) {
    constexpr std::size_t items = 1000, ticks = 1000;
    World2 world;
    Id mover;
    for (std::size_t i = 0; i < items; ++i) mover = world.add(unit, {.pose = place(3 * static_cast<float>(i))});
    const std::size_t before = allocated_bytes();
    History2 past(world, ticks);
    for (int i = 0; i < 10; ++i) {
        past.record();
        world.move(mover, place(static_cast<float>(i)));
    }
    EXPECT_LT(allocated_bytes() - before, 1'000'000u);  // 20 bytes a tick for each item would be 20 megabytes
}

TEST(History, ReleasesTheShapesOfTicksThatItForgets) {
    constexpr int steps = 100'000;
    constexpr std::size_t size = steps * sizeof(Aabb2);
    World2 world;
    History2 past(world, 3);
    const Id id = world.add(stairs<2>(1, 1));
    past.record();
    const std::size_t before = allocated_bytes();
    world.set_shape(id, stairs<2>(steps, 0.5f));
    past.record();
    world.remove(id);
    for (int i = 0; i < 2; ++i) {
        past.record();
        EXPECT_GT(allocated_bytes(), before + size);
    }
    past.record();
    EXPECT_LT(allocated_bytes(), before + size / 10);
    EXPECT_EQ(past.at(2).size(), 0u);
}

}  // namespace
}  // namespace abut::test
