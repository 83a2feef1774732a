// NaN, infinity and lists that don't fit: an assertion where there are any, and harmless answers.

#include <abut/motion/rearrange.hpp>
#include <abut/query/reflect.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

#include <gtest/gtest.h>

namespace {
int assertions = 0;  // how many there were is up to the build
}

namespace abut {

// This program's own, which goes on.
void assert_failed(const char*, const char*, int) {
    ++assertions;
}

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(BadInput, NobodyWaitsForWhatIsNowhere) {
    const std::vector<Circle> circles{{{0, 0}, 1}, {{nan, 3}, 1}, {{0, 5}, 1}, {{0, 9}, infinity}};
    EXPECT_EQ(removal_order(circles, {0, 1}).order, (std::vector<std::uint32_t>{1, 2, 0, 3}));
    EXPECT_EQ(removal_order(circles, {nan, 1}).order, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(removal_order(circles, {0, 0}).order, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    const std::vector<Sphere> spheres{{{0, 0, 0}, 1}, {{0, infinity, 3}, 1}, {{0, 0, 5}, 1}};
    EXPECT_EQ(removal_order(spheres, {0, 0, 1}).order, (std::vector<std::uint32_t>{1, 2, 0}));
}

TEST(BadInput, IsStuck) {
    const std::vector<Box2> boxes(2, Box2{{0, 0}, {0.5f, 0.5f}});
    const std::vector<Pose2> here{{{0, 0}}, {{1, 0}}}, one{{{0, 0}}}, nowhere{{{0, nan}}, {{1, 0}}};
    EXPECT_TRUE(rearrange(boxes, here, here));
    EXPECT_EQ(rearrange(boxes, here, one).stuck.size(), 2u);
    EXPECT_EQ(rearrange(boxes, here, nowhere).stuck.size(), 2u);
    EXPECT_EQ(rearrange(boxes, nowhere, here).stuck.size(), 2u);
    EXPECT_EQ(rearrange(boxes, here, here, {.away = Vec2(0)}).stuck.size(), 2u);
}

TEST(BadInput, IsThrownBackNowhere) {
    Hit<2> hit{.point = {1, nan}, .normal = {0, 1}};
    EXPECT_EQ(reflect(Ray2{{0, 0}, {1, 0}}, hit).length, 0);
    hit.point = {1, 1};
    EXPECT_EQ(reflect(Ray2{{nan, 0}, {1, 0}}, hit).length, 0);
}

}  // namespace
}  // namespace abut
