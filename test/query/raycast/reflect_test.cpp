// Reflected rays: known answers, and a million reflections between mirrors.

#include "../../oracle/expect.hpp"
#include "../../oracle/random.hpp"
#include <abut/query/reflect.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/half_space.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

TEST(Reflect, ByHand) {
    const Ray3 ray{{-3, 4, 0}, {0.6f, -0.8f, 0}, 12};
    const auto hit = raycast(ray, HalfSpace3{{0, 1, 0}, 0});
    ASSERT_TRUE(hit);
    const Ray3 back = reflect(ray, *hit);
    EXPECT_TRUE(near(back.origin, Vec3(0, 0, 0), 4e-6));
    EXPECT_GE(back.origin.y, 0);
    EXPECT_TRUE(near(back.direction, Vec3(0.6f, 0.8f, 0)));
    EXPECT_NEAR(back.length, 7, 1e-5);
}

TEST(Reflect, OfAnEndlessRayIsEndless) {
    const Ray2 ray{{0, 5}, {0, -1}};
    const Ray2 back = reflect(ray, *raycast(ray, Circle{{0, 0}, 1}));
    EXPECT_EQ(back.direction, Vec2(0, 1));
    EXPECT_EQ(back.length, std::numeric_limits<float>::infinity());
}

TEST(Reflect, OfAHitAtTheEndHasNothingLeft) {
    const Ray2 ray{{0, 5}, {0, -1}, 4};
    const auto hit = raycast(ray, Circle{{0, 0}, 1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(reflect(ray, *hit).length, 0, 1e-5);
}

TEST(Reflect, AtTheStartTurnsRound) {
    const Ray2 ray{{0, 1}, {0, -1}, 4};
    const auto hit = raycast(ray, Circle{{0, 0}, 1});
    ASSERT_TRUE(hit);
    const Ray2 back = reflect(ray, *hit);
    EXPECT_EQ(back.origin, ray.origin);
    EXPECT_EQ(back.direction, Vec2(0, 1));
}

/// A reflected ray does not hit the mirror it left, at any angle, position and size of the shape.
template <int D>
void leaves_its_mirror(std::uint64_t seed) {
    oracle::Random random(seed);
    int hits = 0, grazing = 0;
    for (int repeat = 0; repeat < 200000; ++repeat) {
        const double size = random.power_of_two(-10, 14), far = size * random.power_of_two(-4, 14);
        const DVec<D> center = random.direction<D>() * far;
        Vec<D> half;
        for (int i = 0; i < D; ++i) half[i] = random.uniform_float(0.01 * size, size);
        const Box<D> box{to_float(center), half, random.rotation<D>()};
        const Ball<D> ball{to_float(center), static_cast<float>(size)};
        const bool round = random.chance(0.5), grazes = random.chance(0.5);
        // The ray goes to a point of the surface or beside it, or hits a face or ball at a very small angle.
        DVec<D> target = DVec<D>(box.center) + random.direction<D>() * (size * random.uniform(0.9, 1.0));
        DVec<D> start = DVec<D>(box.center) + random.direction<D>() * (size * random.uniform(2, 20));
        if (grazes) {
            DVec<D> normal = random.direction<D>(), along = random.direction<D>();
            target = DVec<D>(box.center) + normal * size;
            if (!round) {
                normal = affine(Pose<D>{Vec<D>(0), box.rotation}).vector(axis<D>(0));
                target = DVec<D>(box.center) + normal * static_cast<double>(box.half[0]);
            }
            along = normalized(along - normal * dot(normal, along) - normal * random.power_of_two(-26, -7));
            start = target - along * (size * random.uniform(0.01, 20));
        }
        const auto ray = Ray<D>::between(to_float(start), to_float(target));
        const auto cast = [&](const Ray<D>& r) { return round ? raycast(r, ball) : raycast(r, box); };
        const Ray<D> endless{ray.origin, ray.direction};
        const auto hit = cast(endless);
        if (!hit) continue;
        ++hits;
        grazing += dot(DVec<D>(ray.direction), DVec<D>(hit->normal)) > -0.01 ? 1 : 0;
        const Ray<D> back = reflect(endless, *hit);
        EXPECT_NEAR(length(DVec<D>(back.direction)), 1, 2e-7);
        ASSERT_FALSE(cast(back)) << "seed " << seed << ", repeat " << repeat;
    }
    EXPECT_GT(hits, 30000);
    EXPECT_GT(grazing, 10000);
}

TEST(Reflect, LeavesItsMirror2) {
    leaves_its_mirror<2>(41);
}
TEST(Reflect, LeavesItsMirror3) {
    leaves_its_mirror<3>(42);
}

}  // namespace
}  // namespace abut
