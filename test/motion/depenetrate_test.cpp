// Moving a shape out of obstacles.

#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include <abut/motion/depenetrate.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/placed.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::near;
using oracle::Random;

constexpr std::uint64_t depenetrate_seed = 20260722;

TEST(Depenetrate, LeavesWhatIsFreeWhereItIs) {
    World2 world;
    world.add(HalfSpace2{{0, 1}, 0}, {.fixed = true});
    const auto result = depenetrate(Circle{{0, 1.001f}, 1}, world);
    EXPECT_TRUE(result);
    EXPECT_EQ(result.push, Vec2(0));
}

TEST(Depenetrate, LeavesAWallAndTheFloorAtOnce) {
    World3 world;
    world.add(HalfSpace3{{0, 1, 0}, 0}, {.fixed = true});
    world.add(Box3{{3, 0, 0}, {1, 5, 5}}, {.fixed = true});
    const auto result = depenetrate(Box3{{1.8f, 0.7f, 0}, {0.5f, 1, 0.5f}}, world);
    EXPECT_TRUE(result);
    EXPECT_TRUE(near(result.push, Vec3(-0.3f, 0.3f, 0), 1e-3));
}

TEST(Depenetrate, LeavesAFloorOfTilesUpwards) {
    World2 world;
    for (int x = -4; x < 4; ++x) world.add(Box2{{static_cast<float>(x) + 0.5f, -0.5f}, {0.5f, 0.5f}}, {.fixed = true});
    // For each single tile, the shortest separating direction is sideways.
    const auto result = depenetrate(Box2{{0, 0.2f}, {0.1f, 0.4f}}, world);
    EXPECT_TRUE(result);
    EXPECT_TRUE(near(result.push, Vec2(0, 0.2f), 1e-3));
}

TEST(Depenetrate, ReportsThatThereIsNoWayOut) {
    World2 world;
    world.add(HalfSpace2{{1, 0}, 0}, {.fixed = true});
    world.add(HalfSpace2{{-1, 0}, -1}, {.fixed = true});
    const auto result = depenetrate(Circle{{0.4f, 0}, 0.7f}, world);
    EXPECT_FALSE(result);
    EXPECT_GT(result.depth, 0.15f);
}

TEST(Depenetrate, UsesItemsThatPassTheFilterAlone) {
    World2 world;
    world.add(HalfSpace2{{0, 1}, 0}, {.layers = 2, .fixed = true});
    EXPECT_EQ(depenetrate(Circle{{0, 0}, 1}, world, {.mask = 1}).push, Vec2(0));
    EXPECT_NEAR(depenetrate(Circle{{0, 0}, 1}, world, {.mask = 2}).push.y, 1, 1e-3);
}

template <int D>
void at_random() {
    Random random(depenetrate_seed);
    int inside = 0, freed = 0;
    for (int i = 0; i < 300; ++i) {
        World<D> world;
        for (int k = 0; k < 16; ++k) {
            Box<D> box;
            box.center = to_float<D>(random.in_cube<D>() * 3.0);
            for (int axis = 0; axis < D; ++axis) box.half[axis] = random.uniform_float(0.1, 0.8);
            box.rotation = random.rotation<D>();
            world.add(box, {.fixed = true});
        }
        const Capsule<D> shape{to_float<D>(random.in_cube<D>()), to_float<D>(random.in_cube<D>()), 0.3f};
        const bool starts_inside = !world.overlapping(shape).empty();
        const auto result = depenetrate(shape, world);
        const auto nearest = world.closest(at(shape, Pose<D>{result.push}));
        // The shape is inside by more than the tolerance.
        const bool ends_inside = nearest && nearest->closest.distance < -2e-5f;
        EXPECT_TRUE(starts_inside || result.push == Vec<D>(0.0f)) << i;
        EXPECT_EQ(static_cast<bool>(result), !ends_inside) << i << ' ' << result.depth;
        inside += starts_inside ? 1 : 0;
        freed += starts_inside && result ? 1 : 0;
    }
    EXPECT_GT(inside, 100);
    EXPECT_EQ(freed, inside);
}
TEST(Depenetrate, ItsAnswerIsWhetherItIsFree) {
    at_random<2>();
    at_random<3>();
}

}  // namespace
}  // namespace abut
