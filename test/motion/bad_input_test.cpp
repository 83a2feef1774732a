// NaN, infinity and lists of the wrong size: an assertion if they are enabled, and neutral answers.

#include <abut/motion/depenetrate.hpp>
#include <abut/motion/mover.hpp>
#include <abut/motion/rearrange.hpp>
#include <abut/query/reflect.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/half_space.hpp>

#include <gtest/gtest.h>

namespace {
int assertions = 0;  // the number depends on the build
}

namespace abut {

// The assertion handler of this program, which returns.
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

/// A non-finite motion moves nothing, gives no ground, and leaves no state for the next move.
template <int D>
void expect_unmoved() {
    World<D> world;
    Vec<D> up(0.0f), down(0.0f), place(0.0f);
    up[1] = 1;
    down[1] = -0.1f;
    place[1] = 0.55f;
    world.add(HalfSpace<D>{up, 0}, {.fixed = true});
    const Ball<D> ball{Vec<D>(0.0f), 0.5f};
    Mover<D> mover;
    for (const float bad : {nan, infinity, -infinity}) {
        Vec<D> nowhere = place;
        nowhere[0] = bad;
        const int before = assertions;
        for (const Moved<D>& moved : {mover.move(world, ball, place, nowhere), mover.move(world, ball, nowhere, down),
                                      mover.move(world, Ball<D>{nowhere, 0.5f}, place, down),
                                      mover.move(world, Ball<D>{Vec<D>(0.0f), bad}, place, down)}) {
            EXPECT_FALSE(moved.grounded);
            EXPECT_FALSE(moved.crushed);
            EXPECT_EQ(moved.motion, Vec<D>(0.0f));
            EXPECT_TRUE(moved.touches.empty());
            EXPECT_EQ(moved.position[1], place[1]);
        }
        EXPECT_FALSE(depenetrate(Ball<D>{nowhere, 0.5f}, world).push != Vec<D>(0.0f));
#ifndef NDEBUG
        EXPECT_EQ(assertions, before + 5);
#else
        EXPECT_EQ(assertions, before);
#endif
        EXPECT_TRUE(mover.move(world, ball, place, down).grounded);
    }
    // A non-finite `up` is replaced by the default.
    mover.set_options({.up = Vec<D>(nan)});
    EXPECT_TRUE(mover.move(world, ball, place, down).grounded);
}

TEST(BadInput, MovesNowhere) {
    expect_unmoved<2>();
    expect_unmoved<3>();
}

}  // namespace
}  // namespace abut
