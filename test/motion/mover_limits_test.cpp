// A Mover at its limits: corners of all angles in 3D, motions of length 0 and of ten thousand sizes, all scales, far
// from the origin, and between closing walls.

#include "../oracle/random.hpp"
#include <abut/motion/mover.hpp>
#include <abut/query/closest.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/placed.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

constexpr double pi = 3.14159265358979;

/// The largest deviation from rest after the first frames of a constant motion.
template <class S>
float unrest(const World3& world, const S& shape, const Vec3& start, const Vec3& motion, int frames, Vec3& place) {
    Mover3 mover;
    place = start;
    Vec3 rest{};
    float max_move = 0;
    const int settled = 170 + frames / 10;
    for (int i = 0; i < frames; ++i) {
        place = mover.move(world, shape, place, motion).position;
        if (i == settled) rest = place;
        if (i > settled) max_move = std::max(max_move, static_cast<float>(length(DVec<3>(place - rest))));
    }
    return max_move;
}

/// Two vertical walls on a floor, or a gutter of two slopes, at an angle; the mover walks or falls into them.
TEST(MoverLimits, ComesToRestInCornersOfAnyAngleInSpace) {
    const Sphere ball{{0, 0, 0}, 0.5f};
    const Capsule3 capsule{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.4f};
    Box3 box{{0, 0, 0}, {0.4f, 0.9f, 0.3f}};
    box.rotation = glm::quat(0.9659258f, 0, 0.2588190f, 0);  // 30 degrees about the upright
    for (int degrees = 1; degrees <= 179; ++degrees) {
        const Turn half = Turn::by(static_cast<float>(0.5 * degrees * pi / 180));
        World3 room;
        room.add(HalfSpace3{{0, 1, 0}, 0}, {.fixed = true});
        room.add(HalfSpace3{{half.sin, 0, -half.cos}, 0}, {.fixed = true});
        room.add(HalfSpace3{{half.sin, 0, half.cos}, 0}, {.fixed = true});
        // Along walls that are nearly parallel, the mover takes long to reach the corner.
        const int frames = degrees % 60 == 1 ? 10000 : degrees > 170 ? 3000 : 300;
        const float far = 1.5f / half.sin;
        const auto expect_rest = [&](const auto& shape, float height, const char* name) {
            Vec3 place;
            const float max_move = unrest(room, shape, {far, height, 0.01f},
                                          {-0.02f / half.sin, -0.02f, 0.003f * half.cos}, frames, place);
            EXPECT_LT(max_move, 0.5e-4f) << name << ' ' << degrees;
            EXPECT_TRUE(room.overlapping(at(shape, Pose3{place})).empty()) << name << ' ' << degrees;
            EXPECT_LT(place.x, far) << name << ' ' << degrees;
        };
        expect_rest(ball, 0.6f, "ball");
        expect_rest(capsule, 1.0f, "capsule");
        expect_rest(box, 1.0f, "box");
    }
}

TEST(MoverLimits, ComesToRestInGuttersOfAnyAngle) {
    Box3 box{{0, 0, 0}, {0.4f, 0.5f, 0.3f}};
    box.rotation = glm::quat(0.9238795f, 0.2209424f, 0.2209424f, 0.2209424f);
    const Sphere ball{{0, 0, 0}, 0.5f};
    for (int degrees = 1; degrees <= 179; ++degrees) {
        const Turn half = Turn::by(static_cast<float>(0.5 * degrees * pi / 180));
        World3 gutter;
        gutter.add(HalfSpace3{{half.cos, half.sin, 0}, 0}, {.fixed = true});
        gutter.add(HalfSpace3{{-half.cos, half.sin, 0}, 0}, {.fixed = true});
        const int frames = degrees % 60 == 1 ? 10000 : 300;
        Vec3 place;
        for (const bool is_box : {false, true}) {
            const Vec3 start(0.001f, 1.0f / half.sin, 0), motion(0, -0.02f / half.sin, 0);
            const float max_move = is_box ? unrest(gutter, box, start, motion, frames, place)
                                          : unrest(gutter, ball, start, motion, frames, place);
            EXPECT_LT(max_move, 0.5e-4f) << degrees << ' ' << is_box;
            EXPECT_TRUE(
                (is_box ? gutter.overlapping(at(box, Pose3{place})) : gutter.overlapping(at(ball, Pose3{place})))
                    .empty())
                << degrees << ' ' << is_box;
        }
    }
}

/// The floor of a room so many times the usual one, with its corner so far from the origin.
struct Room {
    World3 world;
    float scale;
    Vec3 corner;

    Room(float size, const Vec3& from) : scale(size), corner(from) {
        const auto add = [&](const Vec3& low, const Vec3& high) {
            world.add(Box3{corner + 0.5f * scale * (low + high), 0.5f * scale * (high - low)}, {.fixed = true});
        };
        add({-1, -1, -1}, {9, 0, 9});  // the floor
        add({-1, 0, -1}, {0, 4, 9});   // four walls
        add({8, 0, -1}, {9, 4, 9});
        add({-1, 0, -1}, {9, 4, 0});
        add({-1, 0, 8}, {9, 4, 9});
        add({3, 0, 3}, {5, 0.25f, 5});  // a step
    }
    Capsule3 hero() const { return {scale * Vec3(0, -0.5f, 0), scale * Vec3(0, 0.5f, 0), 0.4f * scale}; }
    MoverOptions<3> options() const { return {.step_height = 0.3f * scale, .stick = 0.3f * scale}; }
    bool is_free(const Vec3& place) const { return world.overlapping(at(hero(), Pose3{place})).empty(); }
};

TEST(MoverLimits, AllScalesAreAlikeAndFarFromTheOriginToo) {
    for (const float scale : {1e-3f, 1e-2f, 1.0f, 100.0f, 1e4f}) {
        for (const bool far : {false, true}) {
            // 1e5 sizes away a float knows places to 1/128 of the size.
            const float away = far ? 1e5f * scale : 0;
            const Room room(scale, {away, 0, -away});
            Mover3 mover(room.options());
            Vec3 place = room.corner + scale * Vec3(1, 1, 4);
            Moved<3> moved;
            float highest = 0;
            for (int i = 0; i < 200; ++i) {
                moved = mover.move(room.world, room.hero(), place, scale * Vec3(0.0625f, -0.03125f, 0));
                place = moved.position;
                highest = std::max(highest, place.y);
                ASSERT_TRUE(is_finite(place)) << scale << ' ' << far << ' ' << i;
                // Nowhere deeper than the rounding of its own place.
                const auto nearest = room.world.closest(at(room.hero(), Pose3{place}));
                ASSERT_GT(nearest->closest.distance, far ? -0.01f * scale : 0.0f) << scale << ' ' << far << ' ' << i;
            }
            // Over the step, to the wall, and on the ground again.
            EXPECT_TRUE(moved.grounded) << scale << ' ' << far;
            EXPECT_FALSE(moved.crushed) << scale << ' ' << far;
            EXPECT_NEAR(highest / scale, 1.15, 0.03) << scale << ' ' << far;
            EXPECT_NEAR(place.y / scale, 0.9, 0.03) << scale << ' ' << far;
            EXPECT_NEAR((place.x - room.corner.x) / scale, 7.6, far ? 0.05 : 0.01) << scale << ' ' << far;
        }
    }
}

TEST(MoverLimits, MotionsOfNothingAndOfAlmostNothing) {
    const Room room(1, {0, 0, 0});
    Mover3 mover(room.options());
    Vec3 place(2, 0.91f, 4);
    for (int i = 0; i < 20; ++i) place = mover.move(room.world, room.hero(), place, {0, -0.02f, 0}).position;
    const Vec3 rest = place;
    for (int i = 0; i < 1000; ++i) {
        const Moved<3> moved = mover.move(room.world, room.hero(), place, {0, 0, 0});
        ASSERT_TRUE(moved.grounded) << i;
        ASSERT_EQ(moved.position, rest) << i;
        ASSERT_EQ(moved.motion, Vec3(0)) << i;
    }
    // Motions below the minimal length add up to nothing, or to the requested motion, never to more.
    for (const float speed : {1e-6f, 1e-5f, 1e-4f}) {
        place = rest;
        for (int i = 0; i < 1000; ++i) {
            const Moved<3> moved = mover.move(room.world, room.hero(), place, {speed, -speed, 0});
            ASSERT_TRUE(moved.grounded) << speed << ' ' << i;
            ASSERT_LE(std::abs(moved.position.x - place.x), 1.3f * speed + 2e-7f) << speed << ' ' << i;
            place = moved.position;
        }
        EXPECT_NEAR(place.y, rest.y, 1e-5) << speed;
        EXPECT_GE(place.x, rest.x) << speed;
        EXPECT_NEAR(place.x - rest.x, 1000 * speed, speed < 2e-6f ? 3e-4 : 0.02 * 1000 * static_cast<double>(speed))
            << speed;
    }
}

TEST(MoverLimits, HugeMotionsStopAtTheFirstWall) {
    const Room room(1, {0, 0, 0});
    oracle::Random random(20260926);
    for (int i = 0; i < 300; ++i) {
        Mover3 mover(room.options());
        const Vec3 from(1 + random.uniform_float(0, 1.5), 0.95f, random.uniform_float(0.5, 7.5));
        const DVec<2> direction = random.direction<2>() * 1e4;
        const Moved<3> moved = mover.move(room.world, room.hero(), from,
                                          {static_cast<float>(direction.x), -100, static_cast<float>(direction.y)});
        ASSERT_TRUE(is_finite(moved.position)) << i;
        ASSERT_TRUE(room.is_free(moved.position)) << i;
        ASSERT_LT(length(DVec<3>(moved.position - from)), 1.0002e4 + 100) << i;
        ASSERT_GT(moved.position.y, 0.89f) << i;
        for (const float across : {moved.position.x, moved.position.z}) {
            ASSERT_GT(across, 0.39f) << i;
            ASSERT_LT(across, 7.61f) << i;
        }
    }
}

/// Regression: a mover that ran against a low edge at 20 per frame was lifted by 9, along the plane of the edge.
TEST(MoverLimits, LowEdgesThrowNobodyUp) {
    const Room room(1, {0, 0, 0});
    int over = 0;
    for (const float speed : {0.3f, 1.0f, 5.0f, 20.0f})
        for (int i = 0; i < 40; ++i) {
            Mover3 mover(room.options());
            const float gap = 0.005f * static_cast<float>(i);
            Vec3 place(1.2f, 0.904f + gap, 4);
            float highest = 0;
            for (int k = 0; k < 30; ++k) {
                place = mover.move(room.world, room.hero(), place, {speed, -0.02f, 0}).position;
                highest = std::max(highest, place.y);
            }
            ASSERT_LT(highest, 1.17f + gap) << speed << ' ' << gap;
            over += place.x > 7.5f ? 1 : 0;
        }
    EXPECT_EQ(over, 160);
}

template <int D>
Box<D> slab(float low, float high) {
    Box<D> result;
    result.half = Vec<D>(3.0f);
    result.center = Vec<D>(0.0f);
    result.center[1] = 0.5f * (low + high);
    result.half[1] = 0.5f * (high - low);
    return result;
}

/// A lift rises under a ceiling with a mover of height 2 on it.
template <int D>
void ride_into_the_ceiling() {
    World<D> world;
    world.add(slab<D>(5, 6), {.fixed = true});
    const Id lift = world.add(slab<D>(-1, 0));
    Vec<D> a(0.0f), b(0.0f), down(0.0f), place(0.0f);
    a[1] = -0.5f;
    b[1] = 0.5f;
    down[1] = -0.02f;
    place[1] = 1.02f;
    const Capsule<D> hero{a, b, 0.5f};
    Mover<D> mover;
    double crushed_from = 0;
    for (int i = 1; i <= 200; ++i) {
        Pose<D> pose;
        pose.position[1] = 0.02f * static_cast<float>(i);
        world.move(lift, pose);
        const Moved<D> moved = mover.move(world, hero, place, down);
        place = moved.position;
        ASSERT_TRUE(is_finite(place)) << i;
        const double room = 5 - static_cast<double>(pose.position[1]);
        if (moved.crushed && crushed_from == 0) crushed_from = room;
        if (room > 2.001) {
            ASSERT_FALSE(moved.crushed) << D << ' ' << room;
            ASSERT_TRUE(world.overlapping(at(hero, Pose<D>{place})).empty()) << D << ' ' << room;
        } else if (room < 1.97) {
            ASSERT_TRUE(moved.crushed) << D << ' ' << room;
        }
    }
    EXPECT_NEAR(crushed_from, 2, 0.04);
    // The lift goes down again, and the mover is free and grounded.
    world.move(lift, {});
    for (int i = 0; i < 300; ++i) place = mover.move(world, hero, place, down).position;
    const Moved<D> moved = mover.move(world, hero, place, down);
    EXPECT_TRUE(moved.grounded && !moved.crushed);
    EXPECT_NEAR(place[1], 1, 0.03);
}

/// A slab on the corners of two boxes that are nearly one was thrown up by 0.6: behind a plane through a corner its far
/// end is that deep.
TEST(MoverLimits, RidgesOfTwoPiecesThrowNobodyUp) {
    constexpr float eighth = 0.785398163f, diagonal = 0.707106781f;
    for (const float lower : {0.0f, 1e-5f, 1e-4f, 5e-4f, 1e-3f})
        for (const float aside : {0.0f, 1e-5f, 1e-4f, 3e-4f, 1e-3f, 2e-3f}) {
            SCOPED_TRACE(lower);
            SCOPED_TRACE(aside);
            World2 world;
            for (const Vec2& corner : {Vec2(0, -lower), Vec2(aside, 0)})
                world.add(Box2{{0, 0}, {0.5f, 0.5f}},
                          {.pose = {corner - Vec2(0, diagonal), Turn::by(eighth)}, .fixed = true});
            Mover2 mover;
            const Moved<2> moved = mover.move(world, Box2{{0, 0}, {2, 1}}, {0.3f, 0.99f}, {0.1f, 0});
            EXPECT_NEAR(moved.position.x, 0.4f, 1e-3);
            EXPECT_NEAR(moved.position.y, 1.01f, 5e-3);
        }
}

TEST(MoverLimits, IsCrushedByALiftUnderACeilingWhereThereIsNoRoomLeft) {
    ride_into_the_ceiling<2>();
    ride_into_the_ceiling<3>();
}

/// A mover between two closing platforms above a floor neither jumps nor moves away.
TEST(MoverLimits, IsCrushedBetweenWhatCloses) {
    World3 world;
    world.add(HalfSpace3{{0, 1, 0}, 0}, {.fixed = true});
    world.add(Box3{{0, 3, 0}, {9, 0.9f, 9}}, {.fixed = true});
    const Id left = world.add(Box3{{-4, 1, 0}, {1, 1.2f, 9}}), right = world.add(Box3{{4, 1, 0}, {1, 1.2f, 9}});
    const Capsule3 hero{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.5f};
    Mover3 mover;
    Vec3 place(0, 1.02f, 0);
    for (int i = 1; i <= 250; ++i) {
        const float by = 0.01f * static_cast<float>(i);
        world.move(left, {{by, 0, 0}});
        world.move(right, {{-by, 0, 0}});
        const Moved<3> moved = mover.move(world, hero, place, {0.03f, -0.02f, 0});
        place = moved.position;
        const float room = 6 - 2 * by;
        ASSERT_TRUE(is_finite(place)) << room;
        ASSERT_LT(std::abs(place.x), 2.6f) << room;
        if (room > 1.01f) {
            ASSERT_FALSE(moved.crushed) << room;
            ASSERT_TRUE(world.overlapping(at(hero, Pose3{place})).empty()) << room;
        } else if (room < 0.97f) {
            ASSERT_TRUE(moved.crushed) << room;
        }
    }
}

}  // namespace
}  // namespace abut
