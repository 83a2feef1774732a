// Queries of a world with known answers, before the update that takes the items into the trees and after it.

#include "support/before_and_after_update.hpp"
#include "support/bits.hpp"
#include "support/circles.hpp"
#include "support/random_shapes.hpp"
#include <abut/world/world.hpp>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

const Ray2 to_the_right{{-10, 0}, {1, 0}, 100};

TEST(Queries, EmptyWorldHasNoAnswers) {
    World2 world;
    before_and_after_update(world, [&] {
        EXPECT_FALSE(world.raycast(to_the_right));
        EXPECT_FALSE(world.raycast_any(to_the_right));
        EXPECT_TRUE(world.raycast_all(to_the_right).empty());
        EXPECT_FALSE(world.closest(Vec2(0, 0)));
        EXPECT_TRUE(world.overlapping(unit).empty());
        EXPECT_TRUE(world.containing({0, 0}).empty());
    });
}

TEST(Queries, RayHitsItemsFrontToBack) {
    World2 world;
    const Id far = world.add(unit, {.pose = place(8)}), near = world.add(unit, {.pose = place(-4)}),
             between = world.add(unit, {.pose = place(2), .fixed = true});
    world.add(unit, {.pose = place(0, 5)});
    before_and_after_update(world, [&] {
        const auto first = world.raycast(to_the_right);
        ASSERT_TRUE(first);
        EXPECT_EQ(first->id, near);
        EXPECT_EQ(first->hit.distance, 5);
        EXPECT_EQ(first->hit.fraction, 0.05f);
        EXPECT_EQ(first->hit.point, Vec2(-5, 0));
        EXPECT_EQ(first->hit.normal, Vec2(-1, 0));
        const auto all = world.raycast_all(to_the_right);
        ASSERT_EQ(all.size(), 3u);
        EXPECT_EQ(all[0].id, near);
        EXPECT_EQ(all[1].id, between);
        EXPECT_EQ(all[1].hit.distance, 11);
        EXPECT_EQ(all[2].id, far);
        EXPECT_EQ(all[2].hit.distance, 17);
        EXPECT_FALSE(world.raycast({{-10, 0}, {1, 0}, 4.5f}));
    });
}

TEST(Queries, LowestIdWinsAmongEquallyNear) {
    World2 world;
    std::vector<Id> ids;
    for (int i = 0; i < 20; ++i) ids.push_back(world.add(unit, {.fixed = i % 3 == 0}));
    const auto check = [&] {
        EXPECT_EQ(world.raycast(to_the_right)->id, ids.front());
        const auto all = world.raycast_all(to_the_right);
        EXPECT_TRUE(std::equal(all.begin(), all.end(), ids.begin(), ids.end(),
                               [](const WorldHit<2>& hit, Id id) { return hit.id == id; }));
        EXPECT_EQ(world.closest(Vec2(3, 0))->id, ids.front());
        EXPECT_EQ(world.closest(unit)->id, ids.front());
        EXPECT_EQ(world.overlapping(unit), ids);
        EXPECT_EQ(world.containing({0, 0}), ids);
    };
    before_and_after_update(world, check);
    // The item with the lowest id moves first, and then all the others do.
    world.move(ids.front(), place(5));
    world.move(ids.front(), place(0));
    check();
    world.update();
    for (const Id id : ids)
        if (id != ids.front()) world.move(id, {{0, 0}, Turn{0, 1}});
    check();
}

TEST(Queries, ClosestIsSignedAndFromTheQuerysShape) {
    World2 world;
    const Id left = world.add(unit, {.pose = place(-5)}), right = world.add(unit, {.pose = place(4), .fixed = true});
    before_and_after_update(world, [&] {
        const auto gap = world.closest(Circle{{0, 0}, 0.5f});
        ASSERT_TRUE(gap);
        EXPECT_EQ(gap->id, right);
        EXPECT_EQ(gap->closest.distance, 2.5f);
        EXPECT_EQ(gap->closest.normal, Vec2(1, 0));
        EXPECT_EQ(gap->closest.on_a, Vec2(0.5f, 0));
        EXPECT_EQ(gap->closest.on_b, Vec2(3, 0));
        const auto inside = world.closest(Vec2(-5.5f, 0));
        ASSERT_TRUE(inside);
        EXPECT_EQ(inside->id, left);
        EXPECT_EQ(inside->closest.distance, -0.5f);
        // The deeper overlap is the closest.
        EXPECT_EQ(world.closest(Capsule2{{-5, 0}, {4, 0}, 0.25f}, {.ignore = left})->id, right);
    });
}

TEST(Queries, FilterPicksByLayersMaskSensorsAndId) {
    World2 world;
    const Id plain = world.add(unit), ghost = world.add(unit, {.sensor = true}),
             wall = world.add(unit, {.layers = 2, .fixed = true}), picky = world.add(unit, {.mask = 4});
    using Ids = std::vector<Id>;
    before_and_after_update(world, [&] {
        const auto found = [&](const Filter& filter) {
            const Ids ids = world.overlapping(unit, filter);
            EXPECT_EQ(world.containing({0, 0}, filter), ids);
            Ids hit;
            for (const WorldHit<2>& each : world.raycast_all(to_the_right, filter)) hit.push_back(each.id);
            EXPECT_EQ(hit, ids);
            EXPECT_EQ(world.raycast(to_the_right, filter).has_value(), !ids.empty());
            EXPECT_EQ(world.raycast_any(to_the_right, filter), !ids.empty());
            const auto nearest = world.closest(unit, filter);
            EXPECT_EQ(nearest ? nearest->id : Id{}, ids.empty() ? Id{} : ids.front());
            return ids;
        };
        EXPECT_EQ(found({}), (Ids{plain, wall, picky}));
        EXPECT_EQ(found({.sensors = true}), (Ids{plain, ghost, wall, picky}));
        EXPECT_EQ(found({.layers = 1}), (Ids{plain, wall}));
        EXPECT_EQ(found({.layers = 4}), (Ids{plain, wall, picky}));
        EXPECT_EQ(found({.mask = 2}), Ids{wall});
        EXPECT_EQ(found({.mask = 8}), Ids{});
        EXPECT_EQ(found({.ignore = plain}), (Ids{wall, picky}));
    });
}

TEST(Queries, SeeEveryChangeAtOnce) {
    World2 world;
    const Id id = world.add(unit);
    world.update();
    const Vec2 here(0, 0), there(20, 0);
    world.move(id, place(20));
    EXPECT_TRUE(world.containing(here).empty());
    EXPECT_EQ(world.containing(there), std::vector{id});
    world.set_shape(id, Circle{{-20, 0}, 1});
    EXPECT_EQ(world.containing(here), std::vector{id});
    world.set_filter(id, 2, 2);
    EXPECT_TRUE(world.containing(here, {.layers = 1}).empty());
    EXPECT_EQ(world.containing(here, {.layers = 2}), std::vector{id});
    world.remove(id);
    EXPECT_TRUE(world.containing(here).empty());
    const Id next = world.add(unit);
    EXPECT_EQ(world.containing(here), std::vector{next});
    world.update();
    EXPECT_EQ(world.containing(here), std::vector{next});
}

TEST(Queries, VisitorsStopOrGoOn) {
    World2 world;
    for (int i = 0; i < 10; ++i) world.add(unit, {.fixed = i % 2 == 0});
    before_and_after_update(world, [&] {
        int visits = 0;
        world.each_overlapping(unit, [&](Id) { ++visits; });
        EXPECT_EQ(visits, 10);
        for (int limit = 1; limit <= 10; ++limit) {
            visits = 0;
            world.each_overlapping(unit, [&](Id) { return ++visits < limit; });
            EXPECT_EQ(visits, limit);
        }
    });
}

TEST(Queries, HalfSpacesReachEverywhereAndDontPair) {
    World2 world;
    const Id ground = world.add(HalfSpace2{{0, 1}, 0}, {.fixed = true}), ball = world.add(unit, {.pose = place(0, 5)});
    before_and_after_update(world, [&] {
        EXPECT_EQ(world.containing({1e6f, -1e6f}), std::vector{ground});
        EXPECT_EQ(world.overlapping(Circle{{-3e5f, 1}, 1}), std::vector{ground});
        EXPECT_EQ(world.closest(Vec2(1e6f, 2))->id, ground);
        EXPECT_EQ(world.raycast({{700, 3}, {0, -1}})->hit.distance, 3);
        const HalfSpace2 half_space{{0, -1}, -1};
        EXPECT_EQ(world.overlapping(half_space), std::vector{ball});
        EXPECT_EQ(world.closest(half_space)->id, ball);
        EXPECT_EQ(world.closest(half_space)->closest.distance, -5);
    });
}

/// A segment with a support function alone, so that a raycast is iterative.
struct Rod {
    Vec2 from{2, -3}, to{3, -2};
};
[[maybe_unused]] Aabb2 bounds(const Rod& rod) {
    return {rod.from, rod.to};
}
Vec2 support(const Rod& rod, const Vec2& direction) {
    return direction.x + direction.y > 0 ? rod.to : rod.from;
}

// A ray that misses a shape by less than the rounding of a raycast is a hit, although it misses the shape's box.
// Regression: it was a hit only until the shape was in the tree.
TEST(Queries, GrazingRayHitsBeforeAndAfterTheUpdate) {
    const Rod segment;
    const Ray2 grazing{{-2.5f, -1}, {0.913811564f, -0.40613848f}, 10};
    const auto expected = raycast(grazing, segment);
    ASSERT_TRUE(expected);
    for (const bool fixed : {false, true}) {
        World2 world;
        world.add(segment, {.fixed = fixed});
        before_and_after_update(world, [&] {
            const auto found = world.raycast(grazing);
            ASSERT_TRUE(found);
            EXPECT_EQ(Bits(found->hit), Bits(*expected));
        });
    }
}

// Regression: before the update, a query returned a closest item with infinite distance.
TEST(Queries, ShapesWithoutPartsAreNowhere) {
    World2 world;
    world.add(Stairs<2>{});
    before_and_after_update(world, [&] {
        EXPECT_FALSE(world.closest(Vec2(0, 0)));
        EXPECT_FALSE(world.closest(unit));
        EXPECT_FALSE(world.raycast(to_the_right));
        EXPECT_TRUE(world.overlapping(HalfSpace2{{0, 1}, 0}).empty());
        EXPECT_TRUE(world.containing({0, 0}).empty());
    });
    const Id ball = world.add(unit);
    before_and_after_update(world, [&] {
        EXPECT_EQ(world.closest(Vec2(0, 0))->id, ball);
        EXPECT_FALSE(world.closest(Stairs<2>{}));
    });
}

// Regression: after an update with continuous items, a box found an item at any place of its motion.
TEST(Queries, BoxFindsItemsWhereTheyAre) {
    World2 world;
    const Id bullet = world.add(unit, {.continuous = true});
    world.update();
    world.move(bullet, place(20));
    const auto found_at = [&](float x) {
        int found = 0;
        world.each_in_box(Aabb2{{x - 1, -1}, {x + 1, 1}}, [&](Id, const View<2>&) { ++found; });
        return found;
    };
    before_and_after_update(world, [&] {
        EXPECT_EQ(found_at(10), 0);
        EXPECT_EQ(found_at(20), 1);
    });
}

}  // namespace
}  // namespace abut::test
