#include "recorder.hpp"
#include <abut/draw/draw.hpp>
#include <abut/draw/projected.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace abut {
namespace {

const Aabb3 everything{Vec3(-10), Vec3(10)};

TEST(Projected, SeesRightAndUpAsTheEyeDoes) {
    test::Recorder<2> flat;
    const Projected from_front(flat, everything, {0, 0, 1}, {0, 1, 0});
    EXPECT_EQ(from_front({1, 2, 3}), Vec2(1, 2));
    const Projected from_the_right(flat, everything, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(from_the_right({1, 2, 3}), Vec2(-3, 2));
    const Projected from_above(flat, everything, {0, 0, 5}, {0, 2, 0.5f});
    EXPECT_EQ(from_above({1, 2, 3}), Vec2(1, 2));
}

TEST(Projected, IsometricSeesTheThreeAxesEquallyLong) {
    test::Recorder<2> flat;
    const Projected view(flat, everything, {1, 1, 1}, {0, 0, 1});
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        const Vec2 seen = view(axis);
        EXPECT_NEAR(std::hypot(seen.x, seen.y), std::sqrt(2.0 / 3), 1e-6);
    }
    EXPECT_NEAR(view({0, 0, 1}).x, 0, 1e-6);
    EXPECT_GT(view({0, 0, 1}).y, 0);
}

TEST(Projected, StaysFiniteWhereUpIsTowardsTheEye) {
    test::Recorder<2> flat;
    for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0)}) {
        const Vec2 seen = Projected(flat, everything, {0, 0, 1}, up)({3, 4, 5});
        EXPECT_NEAR(std::hypot(seen.x, seen.y), 5, 1e-5);
    }
}

TEST(Projected, HandsEveryCallOn) {
    test::Recorder<2> flat;
    Projected view(flat, everything, {0, 0, 1}, {0, 1, 0});
    draw(view, Box3{{1, 2, 3}, {1, 1, 1}}, {.fill = {1, 2, 3}});
    EXPECT_EQ(flat.lines.size(), 12u);
    EXPECT_EQ(flat.polygons.size(), 6u);
    draw(view, Sphere{{1, 2, 3}, 0});
    EXPECT_EQ(flat.points, std::vector<Vec2>{Vec2(1, 2)});
    draw(view, Sphere{{1, 2, 3}, 4});
    ASSERT_EQ(flat.balls.size(), 1u);
    EXPECT_EQ(flat.balls[0].center, Vec2(1, 2));
    EXPECT_EQ(flat.balls[0].radius, 4);
    EXPECT_EQ(flat.polygons.size(), 6u + 3u);
    view.text({1, 2, 3}, "here", {});
    EXPECT_EQ(flat.texts, std::vector<std::string>{"here"});
}

}  // namespace
}  // namespace abut
