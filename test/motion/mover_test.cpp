// A mover on floors, walls, slopes, steps and platforms, with known answers.

#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include <abut/motion/depenetrate.hpp>
#include <abut/motion/mover.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/segment.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

constexpr float gravity = 0.02f;  // the fall in each frame

template <int D>
Vec<D> down() {
    Vec<D> result(0.0f);
    result[1] = -gravity;
    return result;
}
template <int D>
Vec<D> ahead(float speed) {
    Vec<D> result = down<D>();
    result[0] = speed;
    return result;
}

/// A shape around its center, 2 high.
template <int D>
Capsule<D> hero() {
    Vec<D> a(0.0f), b(0.0f);
    a[1] = -0.5f;
    b[1] = 0.5f;
    return {a, b, 0.5f};
}
template <int D>
Box<D> crate() {
    Box<D> result;
    result.half = Vec<D>(0.4f);
    result.half[1] = 1;
    return result;
}

template <int D>
Vec<D> at_height(float height) {
    Vec<D> result(0.0f);
    result[1] = height;
    return result;
}

template <int D>
HalfSpace<D> level_ground() {
    return {at_height<D>(1), 0};
}

/// A box given by its sides.
template <int D>
Box<D> block(float from_x, float to_x, float from_y, float to_y) {
    Box<D> result;
    result.half = Vec<D>(50.0f);
    result.center = Vec<D>(0.0f);
    result.center[0] = 0.5f * (from_x + to_x);
    result.center[1] = 0.5f * (from_y + to_y);
    result.half[0] = 0.5f * (to_x - from_x);
    result.half[1] = 0.5f * (to_y - from_y);
    return result;
}

template <class Dimension>
class MoverIn : public testing::Test {
protected:
    static constexpr int D = Dimension::value;

    World<D> world;
    Mover<D> mover;
    Vec<D> position = at_height<D>(1.05f);
    Moved<D> moved;

    /// Runs a number of frames with a constant motion.
    template <class S>
    void go(const S& shape, const Vec<D>& motion, int frames) {
        for (int i = 0; i < frames; ++i) {
            moved = mover.move(world, shape, position, motion);
            position = moved.position;
        }
    }
    template <class S>
    bool is_free(const S& shape) const {
        return world.overlapping(at(shape, Pose<D>{position})).empty();
    }
};

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(MoverIn, Dimensions);

TYPED_TEST(MoverIn, LandsAndReportsItsGround) {
    static constexpr int N = TestFixture::D;
    const Id floor = this->world.add(level_ground<N>(), {.fixed = true});
    this->position = at_height<N>(3);
    this->go(hero<N>(), down<N>(), 10);
    EXPECT_FALSE(this->moved.grounded);
    EXPECT_NEAR(this->position[1], 3 - 10 * gravity, 1e-5);
    this->go(hero<N>(), down<N>(), 200);
    EXPECT_TRUE(this->moved.grounded);
    EXPECT_EQ(this->moved.ground.id, floor);
    EXPECT_NEAR(this->moved.ground.normal[1], 1, 1e-6);
    EXPECT_NEAR(this->position[1], 1, 0.03);
    EXPECT_GT(this->position[1], 1);
    ASSERT_EQ(this->moved.touches.size(), 1u);
    EXPECT_TRUE(this->moved.touches[0].is_ground);
    EXPECT_NEAR(this->moved.motion[1], 0, 1e-6);
}

TYPED_TEST(MoverIn, StopsAtAWallAndSlidesAlongIt) {
    static constexpr int N = TestFixture::D;
    this->world.add(level_ground<N>(), {.fixed = true});
    const Id wall = this->world.add(block<N>(2, 3, -1, 5), {.fixed = true});
    for (const bool box : {false, true}) {
        this->position = at_height<N>(1.05f);
        Vec<N> motion = ahead<N>(0.1f);
        if (N == 3) motion[N - 1] = 0.05f;
        if (box)
            this->go(crate<N>(), motion, 60);
        else
            this->go(hero<N>(), motion, 60);
        EXPECT_NEAR(this->position[0], box ? 1.6 : 1.5, 0.02) << box;
        EXPECT_TRUE(box ? this->is_free(crate<N>()) : this->is_free(hero<N>()));
        EXPECT_TRUE(this->moved.grounded);
        EXPECT_NEAR(this->moved.motion[0], 0, 1e-6);
        if (N == 3) {
            EXPECT_NEAR(this->position[N - 1], 60 * 0.05, 1e-3);
        }
        bool is_reported = false;
        for (const MoverTouch<N>& touch : this->moved.touches)
            if (touch.id == wall) {
                is_reported = true;
                EXPECT_NEAR(touch.normal[0], -1, 1e-5);
                EXPECT_FALSE(touch.is_ground);
            }
        EXPECT_TRUE(is_reported);
    }
}

TYPED_TEST(MoverIn, ClimbsStepsUpToItsHeightAndNoHigher) {
    static constexpr int N = TestFixture::D;
    this->world.add(level_ground<N>(), {.fixed = true});
    this->world.add(block<N>(2, 40, -1, 0.25f), {.fixed = true});
    this->world.add(block<N>(4, 40, -1, 0.5f), {.fixed = true});
    this->world.add(block<N>(6, 40, -1, 0.85f), {.fixed = true});
    for (const bool box : {false, true}) {
        this->position = at_height<N>(1.05f);
        for (int i = 0; i < 300; ++i) {
            box ? this->go(crate<N>(), ahead<N>(0.05f), 1) : this->go(hero<N>(), ahead<N>(0.05f), 1);
            ASSERT_TRUE(box ? this->is_free(crate<N>()) : this->is_free(hero<N>())) << box << ' ' << i;
        }
        EXPECT_NEAR(this->position[1], 1.5, 0.03) << box;
        EXPECT_NEAR(this->position[0], box ? 5.6 : 5.5, 0.025) << box;
        EXPECT_TRUE(this->moved.grounded);
        // The mover goes down again, and stays on the ground.
        for (int i = 0; i < 200; ++i) {
            box ? this->go(crate<N>(), ahead<N>(-0.05f), 1) : this->go(hero<N>(), ahead<N>(-0.05f), 1);
            ASSERT_TRUE(this->moved.grounded) << box << ' ' << i << ' ' << this->position[0];
        }
        EXPECT_NEAR(this->position[1], 1, 0.03) << box;
    }
}

/// A plane through the origin that rises along the first axis by an angle in degrees.
template <int D>
HalfSpace<D> slope(double degrees) {
    const Turn turn = Turn::by(static_cast<float>(degrees * 3.14159265358979 / 180));
    Vec<D> normal(0.0f);
    normal[0] = -turn.sin;
    normal[1] = turn.cos;
    return {normal, 0};
}

TYPED_TEST(MoverIn, StandsStillOnSlopesThatAreGroundAndSlidesDownOthers) {
    static constexpr int N = TestFixture::D;
    for (const double degrees : {10.0, 30.0, 49.0, 51.0, 60.0, 80.0}) {
        World<N> hill;
        hill.add(slope<N>(degrees), {.fixed = true});
        Mover<N> walker;
        Vec<N> place = at_height<N>(3);
        for (int i = 0; i < 300; ++i) place = walker.move(hill, hero<N>(), place, down<N>()).position;
        const Vec<N> rest = place;
        for (int i = 0; i < 300; ++i) place = walker.move(hill, hero<N>(), place, down<N>()).position;
        if (degrees < 50) {
            EXPECT_LT(length(DVec<N>(place - rest)), 1e-6) << degrees;
        } else {
            EXPECT_LT(place[1], rest[1] - 1) << degrees;
            // Walking up doesn't help.
            const Vec<N> before = place;
            for (int i = 0; i < 300; ++i) place = walker.move(hill, hero<N>(), place, ahead<N>(0.05f)).position;
            EXPECT_LT(place[1], before[1] + 1e-3) << degrees;
        }
    }
}

TYPED_TEST(MoverIn, WalksUpAndDownSlopesAtTheRequestedSpeed) {
    static constexpr int N = TestFixture::D;
    this->world.add(slope<N>(30), {.fixed = true});
    this->position = at_height<N>(1.4f);
    this->go(hero<N>(), down<N>(), 100);
    for (const float speed : {0.05f, -0.05f, 0.002f, -0.3f}) {
        const Vec<N> before = this->position;
        for (int i = 0; i < 50; ++i) {
            this->go(hero<N>(), ahead<N>(speed), 1);
            ASSERT_TRUE(this->moved.grounded) << speed << ' ' << i;
        }
        const DVec<N> path = DVec<N>(this->position - before);
        EXPECT_NEAR(length(path), std::abs(50 * speed), 0.02) << speed;
        EXPECT_NEAR(path[1] / path[0], 0.57735, 0.02) << speed;
    }
}

TYPED_TEST(MoverIn, RidesWhatItStandsOn) {
    static constexpr int N = TestFixture::D;
    const Id lift = this->world.add(block<N>(-2, 2, -1, 0), {});
    this->go(hero<N>(), down<N>(), 20);
    const Vec<N> before = this->position;
    Pose<N> pose;
    for (int i = 1; i <= 100; ++i) {
        pose.position[0] = 0.05f * static_cast<float>(i);
        pose.position[1] = (i < 50 ? 0.07f : -0.07f) * static_cast<float>(i < 50 ? i : i - 100);
        this->world.move(lift, pose);
        this->go(hero<N>(), down<N>(), 1);
        ASSERT_TRUE(this->moved.grounded) << i;
        ASSERT_TRUE(this->is_free(hero<N>())) << i;
        ASSERT_NEAR(this->position[0] - before[0], pose.position[0], 1e-3) << i;
        ASSERT_NEAR(this->position[1] - before[1], pose.position[1], 0.02) << i;
    }
}

TYPED_TEST(MoverIn, IsPushedByWhatMovesAndKnowsWhenItIsCrushed) {
    static constexpr int N = TestFixture::D;
    this->world.add(level_ground<N>(), {.fixed = true});
    this->world.add(block<N>(3, 4, -1, 5), {.fixed = true});
    const Id press = this->world.add(block<N>(-4, -2, 0.1f, 5), {});
    this->go(hero<N>(), down<N>(), 20);
    int crushed_from = 0;
    for (int i = 1; i <= 100 && crushed_from == 0; ++i) {
        Pose<N> pose;
        pose.position[0] = 0.06f * static_cast<float>(i);
        this->world.move(press, pose);
        this->go(hero<N>(), down<N>(), 1);
        if (this->moved.crushed)
            crushed_from = i;
        else
            ASSERT_TRUE(this->is_free(hero<N>())) << i;
    }
    // The pusher's face moves from -2 until the gap to the wall at 3 is 1.
    EXPECT_NEAR(-2 + 0.06 * crushed_from, 2, 0.07);
}

TYPED_TEST(MoverIn, PassesPlatformsFromBelowWithAFilter) {
    static constexpr int N = TestFixture::D;
    this->world.add(level_ground<N>(), {.fixed = true});
    const Id platform = this->world.add(block<N>(-3, 3, 2.9f, 3), {.fixed = true});
    const auto passes = [&](const MoverTouch<N>& touch) {
        return touch.id == platform && passes_one_way(touch, at_height<N>(1));
    };
    float speed = 0.3f;
    this->position = at_height<N>(1.05f);
    for (int i = 0; i < 200; ++i) {
        Vec<N> motion(0.0f);
        motion[1] = speed;
        speed -= 0.008f;
        this->moved = this->mover.move(this->world, hero<N>(), this->position, motion, passes);
        this->position = this->moved.position;
        if (this->moved.grounded) speed = -0.01f;
    }
    EXPECT_TRUE(this->moved.grounded);
    EXPECT_EQ(this->moved.ground.id, platform);
    EXPECT_NEAR(this->position[1], 4, 0.03);
    // Without the filter, the mover bumps into it.
    this->position = at_height<N>(1.05f);
    this->go(hero<N>(), at_height<N>(0.3f), 20);
    EXPECT_NEAR(this->position[1], 1.9, 0.03);
}

TYPED_TEST(MoverIn, GetsItselfOut) {
    static constexpr int N = TestFixture::D;
    this->world.add(level_ground<N>(), {.fixed = true});
    this->world.add(block<N>(2, 3, -1, 5), {.fixed = true});
    this->position = at_height<N>(0.7f);
    this->position[0] = 1.8f;
    this->go(hero<N>(), Vec<N>(0.0f), 1);
    EXPECT_TRUE(this->is_free(hero<N>()));
    EXPECT_FALSE(this->moved.crushed);
    EXPECT_NEAR(this->moved.pushed[0], -0.3, 0.02);
    EXPECT_NEAR(this->moved.pushed[1], 0.3, 0.02);
}

TYPED_TEST(MoverIn, JumpsFromTheGroundAndSticksToNone) {
    static constexpr int N = TestFixture::D;
    this->world.add(level_ground<N>(), {.fixed = true});
    this->go(hero<N>(), down<N>(), 20);
    const float before = this->position[1];
    this->go(hero<N>(), at_height<N>(0.1f), 1);
    EXPECT_FALSE(this->moved.grounded);
    EXPECT_NEAR(this->position[1] - before, 0.1, 1e-5);
    this->go(hero<N>(), down<N>(), 1);
    EXPECT_NEAR(this->position[1] - before, 0.08, 1e-5);
}

TEST(Mover, TakesAnyUpDirection) {
    World3 world;
    world.add(HalfSpace3{{0, 0, 1}, 0}, {.fixed = true});
    Mover3 mover({.up = {0, 0, 2}});
    Vec3 position{0, 0, 2};
    for (int i = 0; i < 100; ++i)
        position = mover.move(world, Sphere{{0, 0, 0}, 0.5f}, position, Vec3(0.1f, 0, -0.05f)).position;
    EXPECT_NEAR(position.z, 0.5, 0.02);
    EXPECT_NEAR(position.x, 10, 0.02);
}

/// Regression: in a view from above, a wall that faces `up` slightly counts as too steep a slope, and stopped a mover
/// along it.
TYPED_TEST(MoverIn, SlidesAlongEveryWallAlikeWhereThereIsNoUp) {
    static constexpr int N = TestFixture::D;
    oracle::Random random(20260924);
    this->mover.set_options({.up = Vec<N>(0.0f)});
    int wall_hits = 0;
    for (int i = 0; i < 200; ++i) {
        World<N> room;
        const DVec<N> normal = random.template direction<N>();
        room.add(HalfSpace<N>{to_float(normal), 0}, {.fixed = true});
        Vec<N> place = to_float(normal * 0.5100);
        const DVec<N> motion = random.template direction<N>() * 0.1;
        DVec<N> wanted(place);
        for (int k = 0; k < 10; ++k) {
            const Moved<N> now = this->mover.move(room, Ball<N>{Vec<N>(0.0f), 0.5f}, place, to_float(motion));
            ASSERT_FALSE(now.grounded) << i;
            place = now.position;
        }
        const double into = std::min(dot(motion, normal), 0.0);
        wanted += (motion - normal * into) * 10.0;
        wall_hits += into < 0 ? 1 : 0;
        // The mover begins 0.01 from the wall, and stops at half of the skin from it.
        EXPECT_LT(length(DVec<N>(place) - wanted), 0.008) << i;
    }
    EXPECT_GT(wall_hits, 60);
    // Without obstacles, or in a corner without a free direction, there is no ground.
    World<N> none;
    EXPECT_FALSE(this->mover.move(none, Ball<N>{Vec<N>(0.0f), 0.5f}, Vec<N>(0.0f), Vec<N>(0.0f)).grounded);
}

TEST(Mover, ComesToRestInCornersOfAnyAngle) {
    for (int degrees = 1; degrees <= 179; ++degrees) {
        World2 world;
        const double half = 0.5 * degrees * 3.14159265358979 / 180;
        const double sine = static_cast<double>(Turn::by(static_cast<float>(half)).sin);
        const double cosine = static_cast<double>(Turn::by(static_cast<float>(half)).cos);
        // The space between the two planes is free.
        world.add(HalfSpace2{{static_cast<float>(sine), static_cast<float>(-cosine)}, 0}, {.fixed = true});
        world.add(HalfSpace2{{static_cast<float>(sine), static_cast<float>(cosine)}, 0}, {.fixed = true});
        Mover2 mover({.up = {0, 1}, .step_height = 0, .stick = 0});
        const Circle ball{{0, 0}, 0.5f};
        Vec2 position{static_cast<float>(0.6 / sine), 0};
        const Vec2 motion{-0.3f, 0.001f};
        const int frames = degrees % 30 == 1 ? 10000 : 300;
        Vec2 rest{};
        float max_move = 0;
        for (int i = 0; i < frames; ++i) {
            position = mover.move(world, ball, position, motion).position;
            if (i == 100) rest = position;
            if (i > 100) max_move = std::max(max_move, static_cast<float>(length(DVec<2>(position - rest))));
        }
        EXPECT_LT(max_move, 0.5f * 1e-4f) << degrees;
        EXPECT_TRUE(world.overlapping(at(ball, Pose2{position})).empty()) << degrees;
        EXPECT_LT(std::abs(position.x - 0.5 / sine), 0.05 / sine) << degrees;
    }
}

}  // namespace
}  // namespace abut
