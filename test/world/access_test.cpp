// Reading and changing the options of an item: queries see a change at once, the next update reports it.

#include "support/circles.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class Dimension>
class Access : public testing::Test {
protected:
    static constexpr int D = Dimension::value;

    static Pose<D> place(float x) {
        Pose<D> result;
        result.position[0] = x;
        return result;
    }
    Id add(float x, ItemOptions<D> options = {}) {
        options.pose = place(x);
        return world.add(Ball<D>{Vec<D>(0.0f), 1}, options);
    }
    void expect_update(const Pairs& began, const Pairs& stayed, const Pairs& ended, std::size_t contacts) {
        const Events events = world.update();
        EXPECT_EQ(list(events.began), began);
        EXPECT_EQ(list(events.stayed), stayed);
        EXPECT_EQ(list(events.ended), ended);
        EXPECT_EQ(world.contacts().size(), contacts);
    }
    std::vector<Id> found(const Filter& filter = {}) const {
        return world.overlapping(Ball<D>{Vec<D>(0.0f), 0.25f}, filter);
    }

    World<D> world;
};

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Access, Dimensions);

TYPED_TEST(Access, GettersReturnWhatWasGivenAndSet) {
    const Id plain = this->add(0);
    EXPECT_EQ(this->world.layers(plain), 1u);
    EXPECT_EQ(this->world.mask(plain), ~std::uint64_t{0});
    EXPECT_EQ(this->world.group(plain), 0);
    EXPECT_TRUE(this->world.is_enabled(plain));
    EXPECT_FALSE(this->world.is_fixed(plain) || this->world.is_sensor(plain) || this->world.is_continuous(plain));
    const Id all = this->add(5, {.user = 7, .layers = 6, .mask = 9, .fixed = true, .sensor = true, .continuous = true});
    const auto options = this->world.options(all);
    EXPECT_EQ(options.pose, this->place(5));
    EXPECT_EQ(options.user, 7u);
    EXPECT_EQ(options.layers, 6u);
    EXPECT_EQ(options.mask, 9u);
    EXPECT_TRUE(options.fixed && options.sensor && options.continuous);

    this->world.move(all, this->place(8));
    this->world.set_user(all, 70);
    this->world.set_filter(all, 60, 90);
    this->world.set_fixed(all, false);
    this->world.set_sensor(all, false);
    this->world.set_continuous(all, false);
    EXPECT_EQ(this->world.options(all).pose, this->place(8));
    EXPECT_EQ(this->world.user(all), 70u);
    EXPECT_EQ(this->world.layers(all), 60u);
    EXPECT_EQ(this->world.mask(all), 90u);
    EXPECT_FALSE(this->world.is_fixed(all) || this->world.is_sensor(all) || this->world.is_continuous(all));
    EXPECT_EQ(this->world.user(plain), 0u);
}

TYPED_TEST(Access, SettersThatChangeNothingTestNothing) {
    const Id a = this->add(0, {.sensor = true}), b = this->add(1, {.fixed = true});
    this->world.update();
    this->world.set_fixed(a, false);
    this->world.set_fixed(b, true);
    this->world.set_sensor(a, true);
    this->world.set_sensor(b, false);
    this->world.set_continuous(a, false);
    this->world.set_user(a, 5);
    this->expect_update({}, {{a, b}}, {}, 0);
    EXPECT_EQ(this->world.counts().tested, 0u);
}

TYPED_TEST(Access, SensorGoesOnTouchingWithoutAContact) {
    const Id a = this->add(0), b = this->add(1);
    const Pairs pair{{a, b}};
    this->expect_update(pair, {}, {}, 1);
    this->world.set_sensor(b, true);
    EXPECT_EQ(this->found(), std::vector{a}) << "queries skip it at once";
    EXPECT_EQ(this->found({.sensors = true}), (std::vector{a, b}));
    EXPECT_EQ(this->world.contacts().size(), 1u) << "contacts are those of the last update";
    this->expect_update({}, pair, {}, 0);
    EXPECT_EQ(this->world.touching(a), std::vector{b});
    this->world.set_sensor(b, false);
    EXPECT_EQ(this->found(), (std::vector{a, b}));
    this->expect_update({}, pair, {}, 1);
}

TYPED_TEST(Access, TwoFixedItemsEndAndOneOfThemBeginsAgain) {
    const Id a = this->add(0, {.fixed = true}), b = this->add(1), c = this->add(1.5f);
    EXPECT_EQ(list(this->world.update().began), (Pairs{{a, b}, {a, c}, {b, c}}));
    this->world.set_fixed(b, true);
    EXPECT_EQ(this->found(), (std::vector{a, b}));
    const Events fixed = this->world.update();
    EXPECT_EQ(list(fixed.ended), (Pairs{{a, b}}));
    EXPECT_EQ(list(fixed.stayed), (Pairs{{a, c}, {b, c}})) << "moving items still touch it";
    EXPECT_TRUE(fixed.began.empty());
    EXPECT_EQ(this->found(), (std::vector{a, b}));
    // A moved item that is fixed again rests at its new pose.
    this->world.move(b, this->place(20));
    EXPECT_EQ(list(this->world.update().ended), (Pairs{{b, c}}));
    this->world.move(b, this->place(1));
    this->world.set_fixed(b, false);
    const Events moving = this->world.update();
    EXPECT_EQ(list(moving.began), (Pairs{{a, b}, {b, c}}));
    EXPECT_EQ(this->found(), (std::vector{a, b}));
}

// Items move between the two broad phases, which reuse free places.
TYPED_TEST(Access, ManyGoToAndFroBetweenTheBroadPhases) {
    std::vector<Id> ids;
    for (int i = 0; i < 40; ++i) ids.push_back(this->add(1.5f * static_cast<float>(i), {.fixed = i % 2 == 0}));
    EXPECT_EQ(this->world.update().began.size(), 39u);
    for (int round = 0; round < 6; ++round) {
        const bool swapped = round % 2 == 0;
        for (std::size_t i = 0; i < ids.size(); ++i) this->world.set_fixed(ids[i], (i % 2 == 0) != swapped);
        if (round == 3) {
            this->world.remove(ids.back());
            ids.back() = this->add(1.5f * 39);
        }
        const Events events = this->world.update();
        EXPECT_EQ(events.stayed.size(), round == 3 ? 38u : 39u) << round;
        EXPECT_EQ(events.ended.size(), round == 3 ? 1u : 0u) << round;
        EXPECT_EQ(this->found(), std::vector{ids.front()});
    }
    for (const Id id : ids) this->world.set_fixed(id, true);
    EXPECT_EQ(this->world.update().ended.size(), 39u);
    for (const Id id : ids) this->world.set_fixed(id, false);
    EXPECT_EQ(this->world.update().began.size(), 39u);
}

TYPED_TEST(Access, ContinuousCountsTheMotionSinceTheLastUpdate) {
    for (const bool before_it_moves : {false, true}) {
        const Id wall = this->add(0, {.fixed = true}), bullet = this->add(-5);
        const IdPair pair{std::min(wall, bullet), std::max(wall, bullet)};
        this->world.update();
        if (before_it_moves) this->world.set_continuous(bullet, true);
        this->world.move(bullet, this->place(5));
        if (!before_it_moves) this->world.set_continuous(bullet, true);
        const Events passed = this->world.update();
        EXPECT_EQ(list(passed.began), Pairs{pair});
        this->world.set_continuous(bullet, false);
        this->world.move(bullet, this->place(-5));
        EXPECT_TRUE(this->world.update().began.empty()) << "the item is not continuous";
        this->world.remove(wall);
        this->world.remove(bullet);
    }
}

TYPED_TEST(Access, EachItemComesByIndexAndMayBeRemoved) {
    std::vector<Id> ids;
    for (int i = 0; i < 10; ++i) ids.push_back(this->add(3 * static_cast<float>(i), {.fixed = i % 3 == 0}));
    this->world.remove(ids[4]);
    this->world.remove(ids[7]);
    const Id late = this->add(100);
    std::vector<Id> expected = ids;
    std::erase_if(expected, [&](Id id) { return !this->world.contains(id); });
    expected.push_back(late);
    std::sort(expected.begin(), expected.end());
    std::vector<Id> all;
    this->world.each_item([&](Id id) { all.push_back(id); });
    EXPECT_EQ(all, expected);
    all.clear();
    this->world.each_item([&](Id id) {
        all.push_back(id);
        return all.size() < 3;
    });
    EXPECT_EQ(all, (std::vector<Id>(expected.begin(), expected.begin() + 3)));
    this->world.each_item([&](Id id) { this->world.remove(id); });
    EXPECT_EQ(this->world.size(), 0u);
    this->world.each_item([](Id) { FAIL(); });
}

}  // namespace
}  // namespace abut::test
