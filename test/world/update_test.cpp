// The results of an update: pairs that began, stayed and ended; and pairs that are not tested again.

#include "support/bits.hpp"
#include "support/circles.hpp"
#include "support/random_shapes.hpp"
#include <abut/world/world.hpp>

#include <algorithm>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Updates the world and compares all three lists.
void expect_update(World2& world, const Pairs& began, const Pairs& stayed, const Pairs& ended) {
    const Events events = world.update();
    EXPECT_EQ(list(events.began), began);
    EXPECT_EQ(list(events.stayed), stayed);
    EXPECT_EQ(list(events.ended), ended);
}

TEST(Update, PairBeginsStaysAndEnds) {
    World2 world;
    const Id a = world.add(unit), b = world.add(unit, {.pose = place(3)});
    const Pairs pair{{a, b}};
    expect_update(world, {}, {}, {});
    EXPECT_TRUE(world.contacts().empty());
    world.move(b, place(1.5f));
    expect_update(world, pair, {}, {});
    ASSERT_EQ(world.contacts().size(), 1u);
    EXPECT_EQ(world.contacts()[0].a, a);
    EXPECT_EQ(world.contacts()[0].b, b);
    EXPECT_EQ(world.contacts()[0].contact.normal, Vec2(1, 0));
    EXPECT_EQ(world.contacts()[0].contact.depth, 0.5f);
    world.move(a, place(0.5f));
    expect_update(world, {}, pair, {});
    EXPECT_EQ(world.contacts()[0].contact.depth, 1);
    world.move(b, place(2.5f));
    expect_update(world, {}, pair, {});
    EXPECT_EQ(world.contacts()[0].contact.depth, 0) << "touching counts";
    world.move(b, place(-9));
    expect_update(world, {}, {}, pair);
    EXPECT_TRUE(world.contacts().empty());
    expect_update(world, {}, {}, {});
}

TEST(Update, ListsAreSorted) {
    World2 world;
    std::vector<Id> ids;
    for (int i = 0; i < 6; ++i) ids.push_back(world.add(unit, {.pose = place(static_cast<float>((i * 5) % 6) * 0.1f)}));
    Pairs all;
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t j = i + 1; j < ids.size(); ++j) all.push_back({ids[i], ids[j]});
    expect_update(world, all, {}, {});
    // Pairs that touch only inside other items have no contact.
    EXPECT_GT(world.contacts().size(), ids.size());
    Pairs reported;
    for (const WorldContact<2>& contact : world.contacts()) reported.push_back({contact.a, contact.b});
    EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
    EXPECT_TRUE(std::includes(all.begin(), all.end(), reported.begin(), reported.end()));
    for (const Id id : ids) world.move(id, place(0, 0.1f));
    expect_update(world, {}, all, {});
    for (const Id id : ids) world.remove(id);
    expect_update(world, {}, {}, all);
}

TEST(Update, FixedItemsPairWithMovingOnesAlone) {
    World2 world;
    const Id wall = world.add(unit, {.fixed = true});
    world.add(unit, {.fixed = true});
    expect_update(world, {}, {}, {});
    EXPECT_EQ(world.counts().near, 0u);
    const Id ball = world.add(unit, {.pose = place(-1.5f)});
    world.move(wall, place(-3));
    const Events events = world.update();
    EXPECT_EQ(events.began.size(), 2u);
    world.move(wall, place(-30));
    expect_update(world, {}, {{{2, 1}, ball}}, {{wall, ball}});
}

TEST(Update, SensorsHaveEventsAndNoContacts) {
    World2 world;
    const Id door = world.add(unit, {.sensor = true}), player = world.add(unit),
             other = world.add(unit, {.sensor = true});
    const Pairs all{{door, player}, {door, other}, {player, other}};
    expect_update(world, all, {}, {});
    EXPECT_TRUE(world.contacts().empty());
    world.move(player, place(1));
    expect_update(world, {}, all, {});
    EXPECT_TRUE(world.contacts().empty());
    expect_update(world, {}, all, {});
    world.move(player, place(5));
    expect_update(world, {}, {{door, other}}, {{door, player}, {player, other}});
}

TEST(Update, BothSidesMustAgreeToPair) {
    struct Case {
        std::uint32_t layers_a, mask_a, layers_b, mask_b;
        bool pairs;
    };
    const std::uint32_t all = 0xffffffff;
    for (const Case& c : {Case{1, all, 1, all, true}, Case{1, 2, 2, 1, true}, Case{1, 2, 2, 2, false},
                          Case{1, 1, 2, 1, false}, Case{0, all, 1, all, false}, Case{1, 0, 1, all, false},
                          Case{3, 4, 4, 2, true}, Case{1u << 31, 1u << 31, 1u << 31, 1u << 31, true}}) {
        World2 world;
        world.add(unit, {.layers = c.layers_a, .mask = c.mask_a});
        world.add(unit, {.layers = c.layers_b, .mask = c.mask_b});
        EXPECT_EQ(world.update().began.size(), c.pairs ? 1u : 0u) << c.layers_a << " " << c.mask_a;
        EXPECT_EQ(world.counts().near, c.pairs ? 1u : 0u);
    }
}

TEST(Update, NewFilterEndsAndBeginsPairs) {
    World2 world;
    const Id a = world.add(unit), b = world.add(unit, {.pose = place(1), .fixed = true});
    const Pairs pair{{a, b}};
    expect_update(world, pair, {}, {});
    world.set_filter(b, 1, 2);
    expect_update(world, {}, {}, pair);
    EXPECT_TRUE(world.contacts().empty());
    world.set_filter(a, 2, 1);
    expect_update(world, pair, {}, {});
    EXPECT_EQ(world.contacts().size(), 1u);
    world.set_filter(a, 2, 1);
    expect_update(world, {}, pair, {});
}

TEST(Update, NewShapeTouchesAtItsPose) {
    World2 world;
    const Id a = world.add(unit), b = world.add(unit, {.pose = place(5)});
    expect_update(world, {}, {}, {});
    world.set_shape(b, Circle{{0, 0}, 4.5f});
    expect_update(world, {{a, b}}, {}, {});
    EXPECT_EQ(world.contacts()[0].contact.depth, 0.5f);
    world.set_shape(b, Box2{{0, 0}, {2, 2}});
    expect_update(world, {}, {}, {{a, b}});
}

TEST(Update, RemovalEndsPairsOfTheOldId) {
    World2 world;
    const Id a = world.add(unit), b = world.add(unit), c = world.add(unit, {.pose = place(1)});
    expect_update(world, {{a, b}, {a, c}, {b, c}}, {}, {});
    const Bits before(world.contacts());
    EXPECT_GT(world.contacts().size(), 0u);
    world.remove(b);
    EXPECT_EQ(Bits(world.contacts()), before) << "as of the last update";
    expect_update(world, {}, {{a, c}}, {{a, b}, {b, c}});

    // A slot is reused before the update: the pairs of the old id end, those of the new id begin.
    world.remove(a);
    const Id d = world.add(unit), e = world.add(unit);
    EXPECT_NE(d, a);
    EXPECT_NE(e, b);
    EXPECT_EQ(d.index, a.index);
    EXPECT_EQ(e.index, b.index);
    expect_update(world, {{d, e}, {d, c}, {e, c}}, {}, {{a, c}});
    world.remove(e);
    world.remove(world.add(unit));
    expect_update(world, {}, {{d, c}}, {{d, e}, {e, c}});
}

TEST(Update, ItemThatCameAndWentBetweenUpdatesLeavesNoTrace) {
    World2 world;
    world.add(unit);
    world.update();
    world.remove(world.add(unit));
    expect_update(world, {}, {}, {});
    EXPECT_EQ(world.counts().near, 0u);
}

TEST(Update, PairThatDidNotMoveIsNotTestedAgain) {
    World3 world;
    const Mesh mesh = house(1);
    const Id a = world.add(mesh), b = world.add(Sphere{{0, 0, 0}, 0.5f}, {.pose = {{0.9f, 0, 0.3f}}}),
             c = world.add(Sphere{{0, 0, 0}, 0.5f}, {.pose = {{-0.2f, 0.2f, 0}}, .sensor = true}),
             near = world.add(Sphere{{0, 0, 0}, 0.5f}, {.pose = {{-0.9f, -0.9f, 1.2f}}});
    ASSERT_EQ(world.update().began.size(), 2u);
    EXPECT_EQ(world.counts().near, 3u) << "the last one's box overlaps, and it doesn't touch";
    EXPECT_EQ(world.counts().tested, 3u);
    const Bits before(world.contacts());
    EXPECT_EQ(world.contacts().size(), 2u);

    const auto expect_same = [&](std::size_t tested) {
        EXPECT_EQ(world.update().stayed.size(), 2u);
        EXPECT_EQ(world.counts().near, 3u);
        EXPECT_EQ(world.counts().tested, tested);
        EXPECT_EQ(Bits(world.contacts()), before);
    };
    expect_same(0);
    expect_same(0);
    // A move to the same pose changes nothing.
    for (const Id id : {a, b, c, near}) world.move(id, world.pose(id));
    expect_same(0);
    // The pairs of the one moved item are tested, and no others.
    world.move(near, {{-0.9f, -0.95f, 1.2f}});
    expect_same(1);
    world.move(a, {{0, 0, 1e-30f}});
    expect_same(3);
    expect_same(0);
    // An item that moved and returned is tested again, with the same result.
    world.move(b, {{50, 0, 0}});
    world.move(b, {{0.9f, 0, 0.3f}});
    expect_same(1);
}

TEST(Update, HalfSpacesDontPairWithOneAnother) {
    World2 world;
    const Id ground = world.add(HalfSpace2{{0, 1}, 0}), wall = world.add(HalfSpace2{{1, 0}, 0}),
             ball = world.add(unit, {.pose = place(0.5f, 5)});
    expect_update(world, {{wall, ball}}, {}, {});
    world.move(ground, place(0, 4.5f));
    expect_update(world, {{ground, ball}}, {{wall, ball}}, {});
    EXPECT_EQ(world.contacts()[0].contact.depth, 0.5f);
    EXPECT_EQ(world.contacts()[0].contact.normal, Vec2(0, 1));
}

}  // namespace
}  // namespace abut::test
