#include "../oracle/random.hpp"
#include <abut/math/ray.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

TEST(Ray, BetweenByHand) {
    const auto ray = Ray2::between({1, 2}, {4, 6});
    EXPECT_EQ(ray.origin, Vec2(1, 2));
    EXPECT_EQ(ray.direction, Vec2(0.6f, 0.8f));
    EXPECT_EQ(ray.length, 5);
    const auto up = Ray3::between({0, 0, 1}, {0, 0, 9});
    EXPECT_EQ(up.direction, Vec3(0, 0, 1));
    EXPECT_EQ(up.length, 8);
}

TEST(Ray, IsInfiniteByDefault) {
    EXPECT_EQ((Ray2{{0, 0}, {1, 0}}.length), std::numeric_limits<float>::infinity());
    const Ray ray{Vec3(0), Vec3(1, 0, 0), 2.0f};
    EXPECT_EQ(ray.length, 2);
}

template <int D>
void expect_unit(const Vec<D>& direction) {
    EXPECT_NEAR(length(DVec<D>(direction)), 1, 1.2e-7);
}

TEST(Ray, BetweenAPointAndItself) {
    for (const float x : {0.0f, 3.0f, 1e30f}) {
        EXPECT_EQ(Ray2::between(Vec2(x), Vec2(x)).length, 0);
        expect_unit<2>(Ray2::between(Vec2(x), Vec2(x)).direction);
        EXPECT_EQ(Ray3::between(Vec3(x), Vec3(x)).length, 0);
        expect_unit<3>(Ray3::between(Vec3(x), Vec3(x)).direction);
    }
}

TEST(Ray, BetweenAnyTwoPoints) {
    oracle::Random random(6);
    for (int repeat = 0; repeat < 2000; ++repeat) {
        // From near the least float to near the largest.
        const double size = random.power_of_two(-140, 125);
        const Vec3 a(random.in_cube<3>() * size), b(random.in_cube<3>() * size);
        const auto ray = Ray3::between(a, b);
        EXPECT_EQ(ray.origin, a);
        expect_unit<3>(ray.direction);
        const DVec<3> end = DVec<3>(a) + DVec<3>(ray.direction) * double{ray.length};
        EXPECT_LE(length(end - DVec<3>(b)), 4e-7 * size + 1e-44) << "seed 6, repeat " << repeat;
    }
}

}  // namespace
}  // namespace abut::test
