// Misuse of a world: stale and null ids, non-finite numbers. With assertions, each call trips exactly one. Without
// them, or if the user's assert_failed returns, the answer is neutral and nothing else happens.

#include "support/bits.hpp"
#include "support/circles.hpp"
#include "support/random_shapes.hpp"
#include <abut/math/assert.hpp>
#include <abut/world/history.hpp>
#include <abut/world/large_world.hpp>

#include <array>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace {

bool expected = false;
int trips = 0;

}  // namespace

// In all tests of this program, an unexpected assertion is a failure.
void abut::assert_failed(const char* expression, const char* file, int line) {
    if (expected)
        ++trips;
    else
        ADD_FAILURE_AT(file, line) << "assertion failed: " << expression;
}

namespace abut::test {
namespace {

#if defined(NDEBUG) && !defined(ABUT_ENABLE_ASSERTS)
constexpr int once = 0;
#else
constexpr int once = 1;
#endif

int trips_of(const std::function<void()>& misuse) {
    trips = 0;
    expected = true;
    misuse();
    expected = false;
    return trips;
}

constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
const Vec2 nowhere(nan, 0);

/// Calls every function that takes an id, with an invalid id.
void expect_caught(World2& world, Id id) {
    EXPECT_FALSE(world.contains(id));
    EXPECT_EQ(trips_of([&] { world.move(id, {{5, 5}}); }), once);
    EXPECT_EQ(trips_of([&] { world.set_shape(id, Circle{{5, 5}, 3}); }), once);
    EXPECT_EQ(trips_of([&] { world.set_filter(id, 0, 0); }), once);
    EXPECT_EQ(trips_of([&] { world.remove(id); }), once);
    EXPECT_EQ(trips_of([&] { world.remove(std::array{id, id}); }), 2 * once);
    EXPECT_EQ(trips_of([&] { world.move(std::array{id}, std::array{Pose2{{5, 5}}}); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(world.user(id), 0u); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(world.pose(id), Pose2{}); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_TRUE(std::holds_alternative<detail::Convex<2>>(world.shape(id))); }), once);
    EXPECT_EQ(trips_of([&] { world.set_user(id, 9); }), once);
    EXPECT_EQ(trips_of([&] { world.set_fixed(id, true); }), once);
    EXPECT_EQ(trips_of([&] { world.set_sensor(id, true); }), once);
    EXPECT_EQ(trips_of([&] { world.set_continuous(id, true); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(world.options(id).mask, 0u); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(world.layers(id), 0u); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(world.mask(id), 0u); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.is_fixed(id)); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.is_sensor(id)); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.is_continuous(id)); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_TRUE(world.touching(id).empty()); }), once);
    EXPECT_EQ(trips_of([&] { world.each_touching(id, [](Id) { FAIL(); }); }), once);
    EXPECT_EQ(trips_of([&] {
                  EXPECT_FALSE(world.contact({id, id}));
                  EXPECT_FALSE(world.impact({id, id}));
              }),
              0)
        << "pairs of an update may have gone since";
    EXPECT_EQ(trips_of([&] { world.overlapping(unit, {.ignore_ids = std::span(&id, 1)}); }), 0);
    EXPECT_EQ(trips_of([&] { world.overlapping(unit, {.ignore = id}); }), 0) << "an invalid id to ignore is no misuse";
}

TEST(Misuse, InvalidIdsAreCaughtAndChangeNothing) {
    World2 world;
    expect_caught(world, {});
    const Id gone = world.add(unit, {.user = 1}), held = world.add(unit, {.user = 2});
    EXPECT_FALSE(Id{});
    EXPECT_TRUE(gone);
    world.remove(gone);
    const auto check = [&] {
        SCOPED_TRACE("slot " + std::to_string(gone.index));
        expect_caught(world, {});
        expect_caught(world, gone);
        expect_caught(world, {held.index, held.generation + 1});
        expect_caught(world, {1000, 1});
        expect_caught(world, {std::numeric_limits<std::uint32_t>::max(), 1});
        expect_caught(world, {0, 1});
    };
    check();
    world.update();
    check();
    const Id next = world.add(unit, {.pose = {{0.5f, 0}}, .user = 3});
    EXPECT_EQ(next.index, gone.index);
    EXPECT_NE(next, gone);
    check();
    EXPECT_EQ(world.size(), 2u);
    EXPECT_EQ(world.user(held), 2u);
    EXPECT_EQ(world.pose(held), Pose2{});
    EXPECT_EQ(world.user(next), 3u);
    EXPECT_EQ(world.pose(next).position, Vec2(0.5f, 0));
    EXPECT_EQ(world.update().began.size(), 1u);
    check();
    EXPECT_EQ(world.update().stayed.size(), 1u);
}

TEST(Misuse, NonFiniteQueriesHaveNoAnswer) {
    World2 world;
    const auto check = [&] {
        EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.raycast({nowhere, {1, 0}, 1})); }), once);
        EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.raycast({{0, 0}, nowhere, 1})); }), once);
        EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.raycast({{0, 0}, {1, 0}, nan})); }), once);
        EXPECT_EQ(trips_of([&] { EXPECT_TRUE(world.raycast_all({{infinity, 0}, {1, 0}, 1}).empty()); }), once);
        EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.closest(nowhere)); }), once);
        EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.closest(Circle{{0, 0}, infinity})); }), once);
        EXPECT_EQ(trips_of([&] { EXPECT_TRUE(world.k_nearest(nowhere, 3).empty()); }), once);
        EXPECT_EQ(trips_of([&] { EXPECT_TRUE(world.k_nearest(Circle{{0, 0}, nan}, 3).empty()); }), once);
        EXPECT_EQ(trips_of([&] { EXPECT_TRUE(world.overlapping(Circle{nowhere, 1}).empty()); }), once);
        EXPECT_EQ(trips_of([&] { EXPECT_TRUE(world.overlapping(HalfSpace2{{1, 0}, nan}).empty()); }), once);
        EXPECT_EQ(trips_of([&] { world.each_overlapping(Circle{nowhere, 1}, [](Id) { FAIL(); }); }), once);
        EXPECT_EQ(trips_of([&] { EXPECT_TRUE(world.containing(nowhere).empty()); }), once);
    };
    check();
    for (int i = 0; i < 10; ++i) world.add(unit, {.fixed = i % 2 == 0});
    world.add(HalfSpace2{{0, 1}, 0}, {.fixed = true});
    check();
    world.update();
    check();
}

/// A non-finite item has an id and touches nothing.
void expect_nowhere(World2& world, Id id) {
    const auto check = [&] {
        EXPECT_TRUE(world.contains(id));
        EXPECT_FALSE(world.raycast({{-10, 0}, {1, 0}, 100}));
        EXPECT_FALSE(world.closest(unit));
        EXPECT_FALSE(world.closest(Vec2(0, 0)));
        EXPECT_TRUE(world.overlapping(unit).empty());
        EXPECT_TRUE(world.overlapping(HalfSpace2{{0, 1}, 1}).empty());
        EXPECT_TRUE(world.containing({0, 0}).empty());
    };
    check();
    EXPECT_TRUE(world.update().began.empty());
    EXPECT_TRUE(world.contacts().empty());
    check();
}

TEST(Misuse, NonFiniteItemsTouchNothing) {
    for (const bool fixed : {false, true}) {
        World2 world;
        Id id;
        EXPECT_EQ(trips_of([&] { id = world.add(Circle{nowhere, 1}, {.fixed = fixed}); }), once);
        expect_nowhere(world, id);
        EXPECT_EQ(trips_of([&] { world.move(id, {{1, 1}}); }), once) << "the item is still not finite";
        expect_nowhere(world, id);
        world.set_shape(id, unit);
        EXPECT_EQ(world.containing({1, 1}), std::vector{id});

        const Id other = world.add(unit);
        EXPECT_EQ(world.update().began.size(), 1u);
        EXPECT_EQ(trips_of([&] { world.move(id, {{0, infinity}}); }), once);
        EXPECT_EQ(trips_of([&] { world.move(other, {nowhere}); }), once);
        EXPECT_EQ(world.containing({0, 0}), std::vector<Id>{});
        EXPECT_EQ(world.update().ended.size(), 1u);
        expect_nowhere(world, id);
        expect_nowhere(world, other);
        world.move(id, {});
        world.move(other, {});
        EXPECT_EQ(world.update().began.size(), 1u);
    }
}

TEST(Misuse, ThePastOfNonFiniteItemsTripsNothing) {
    World2 world;
    History2 past(world, 4);
    const Id id = world.add(unit);
    for (const Vec2& position : {nowhere, Vec2(0, infinity), Vec2(1, 0), Vec2(infinity, 0)}) {
        EXPECT_EQ(trips_of([&] { world.move(id, {position}); }), detail::is_finite(position) ? 0 : once);
        past.record();
    }
    for (std::uint64_t tick = 0; tick < 4; ++tick) {
        EXPECT_EQ(past.at(tick).raycast({{-10, 0}, {1, 0}, 100}).has_value(), tick == 2);
        EXPECT_FALSE(tick != 2 && past.at(tick, 0.5f).raycast({{-10, 0}, {1, 0}, 100}));
    }
}

TEST(Misuse, ATickThatIsNotHeldIsTheNearestOne) {
    World2 world;
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(History2(world, 0).at(0).size(), 0u); }), 2 * once);
    History2 past(world, 2);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(past.at(0).size(), 0u); }), once);
    const Id id = world.add(unit);
    for (int i = 0; i < 4; ++i) {
        world.move(id, place(static_cast<float>(i)));
        past.record();
    }
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(past.at(1).pose(id), place(2)); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(past.at(4).pose(id), place(3)); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(past.at(2, 1.5f).pose(id), place(3)); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(past.at(2, -1).pose(id), place(2)); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(past.at(2, nan).pose(id), place(2)); }), once);
}

TEST(Misuse, OfALargeWorld) {
    LargeWorld2 world;
    const detail::DVec<2> place(1e7, 0), no_place(static_cast<double>(nan), 0);
    const Id id = world.add(Circle{{0, 0}, 1}, {place}), other = world.add(Circle{{0, 0}, 1}, {place});
    world.remove(other);
    EXPECT_EQ(trips_of([&] { world.move(other, {place}); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_EQ(world.pose(other), PoseD2{}); }), once);
    EXPECT_EQ(trips_of([&] { world.in_world(other, {1, 0}); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.raycast({no_place, {1, 0}, 9})); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.sweep(Circle{}, {no_place}, Vec2(1, 0))); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.sweep(Circle{}, {place}, PoseD2{no_place})); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_FALSE(world.closest(no_place)); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_TRUE(world.overlapping(Circle{}, {no_place}).empty()); }), once);
    EXPECT_EQ(trips_of([&] { EXPECT_TRUE(world.containing(no_place).empty()); }), once);
    EXPECT_EQ(world.overlapping(Circle{}, {place}).size(), 1u);
    EXPECT_EQ(trips_of([&] { world.move(id, {no_place}); }), once);
    EXPECT_TRUE(world.overlapping(Circle{}, {place}).empty());
    world.move(id, {place});
    EXPECT_EQ(world.overlapping(Circle{}, {place}).size(), 1u);
}

}  // namespace
}  // namespace abut::test
