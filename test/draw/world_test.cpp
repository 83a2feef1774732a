#include "recorder.hpp"
#include <abut/draw/world.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

using test::Recorder;

/// A crate on a floor, a sensor around it, a bullet that went through a wall, an item that is not enabled, and one that
/// is out of sight.
struct Room {
    Room() {
        bullet = world.add(Circle{{0, 0}, 0.1f}, {.pose = {{-6, 5}}, .continuous = true});
        world.update();
        world.move(bullet, {{-2, 5}});
        world.update();
    }

    World2 world;
    Id floor = world.add(Box2{{0, -1}, {9, 1}}, {.fixed = true});
    Id crate = world.add(Box2{{0, 0.99f}, {1, 1}});
    Id sensor = world.add(Circle{{0, 1}, 2}, {.sensor = true});
    Id wall = world.add(Box2{{-4, 5}, {0.1f, 1}}, {.fixed = true});
    Id ghost = world.add(Box2{{5, 5}, {1, 1}}, {.enabled = false});
    Id far = world.add(Box2{{50, 5}, {1, 1}});
    Id bullet;
};

const WorldDrawOptions nothing{.shapes = false, .contacts = false, .impacts = false};

template <class Things>
auto count_of(const Things& things, const Color& color) {
    return std::count_if(things.begin(), things.end(), [&](const auto& thing) { return thing.style.stroke == color; });
}

TEST(DrawWorld, ShowsEachItemByWhatItIs) {
    const Room room;
    Recorder<2> canvas;
    WorldDrawOptions options = nothing;
    options.shapes = true;
    draw(canvas, room.world, options);
    EXPECT_EQ(count_of(canvas.polygons, options.fixed.stroke), 2);
    EXPECT_EQ(count_of(canvas.polygons, options.moving.stroke), 1);
    EXPECT_EQ(count_of(canvas.balls, options.moving.stroke), 1);
    EXPECT_EQ(count_of(canvas.balls, options.sensor.stroke), 1);
    EXPECT_EQ(count_of(canvas.polygons, options.not_enabled.stroke), 1);
    EXPECT_EQ(canvas.calls(), 6u) << "the item out of sight is not drawn";

    Recorder<2> without;
    options.disabled = false;
    options.filter = {};
    draw(without, room.world, options);
    EXPECT_EQ(without.calls(), 4u);
}

TEST(DrawWorld, ShowsWhatTheLastUpdateFound) {
    const Room room;
    Recorder<2> contacts;
    WorldDrawOptions options = nothing;
    options.contacts = true;
    draw(contacts, room.world, options);
    EXPECT_EQ(contacts.points.size(), 2u);
    ASSERT_FALSE(contacts.lines.empty());
    EXPECT_EQ(contacts.lines[0].style.stroke, options.contact.stroke);

    Recorder<2> impacts;
    options = nothing;
    options.impacts = true;
    draw(impacts, room.world, options);
    ASSERT_EQ(impacts.points.size(), 1u);
    EXPECT_NEAR(impacts.points[0].x, -4.1f, 1e-3);

    Recorder<2> elsewhere({{3, 3}, {4, 4}});
    options.contacts = true;
    draw(elsewhere, room.world, options);
    EXPECT_EQ(elsewhere.calls(), 0u);

    Recorder<2> pairs;
    options = nothing;
    options.touching = true;
    draw(pairs, room.world, options);
    EXPECT_EQ(pairs.lines.size(), 3u) << "crate and floor, crate and sensor, floor and sensor";
}

TEST(DrawWorld, NamesItems) {
    const Room room;
    Recorder<2> canvas;
    WorldDrawOptions options = nothing;
    options.ids = options.boxes = true;
    draw(canvas, room.world, options);
    EXPECT_EQ(canvas.texts, (std::vector<std::string>{"1:1", "2:1", "3:1", "4:1", "5:1", "7:1"}));
    EXPECT_EQ(count_of(canvas.polygons, options.box.stroke), 6);
}

TEST(DrawWorld, InOneStyle) {
    const Room room;
    Recorder<2> canvas;
    draw(canvas, room.world, {.stroke = {1, 2, 3}});
    EXPECT_EQ(canvas.calls(), 5u);
    Recorder<2> as_options;
    draw(as_options, room.world, {.contacts = false, .impacts = false});
    EXPECT_EQ(as_options.calls(), 6u);
}

}  // namespace
}  // namespace abut
