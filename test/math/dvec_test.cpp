#include "../oracle/random.hpp"
#include <abut/math/dvec.hpp>

#include <limits>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

TEST(DVec, Products) {
    EXPECT_EQ(dot(DVec<2>(1, 2), DVec<2>(3, 4)), 11);
    EXPECT_EQ(dot(DVec<3>(1, 2, 3), DVec<3>(4, 5, 6)), 32);
    EXPECT_EQ(cross(DVec<2>(1, 0), DVec<2>(0, 1)), 1);
    EXPECT_EQ(cross(DVec<3>(1, 0, 0), DVec<3>(0, 1, 0)), DVec<3>(0, 0, 1));
    EXPECT_EQ(length(DVec<2>(3, 4)), 5);
    EXPECT_EQ(largest(DVec<3>(-7, 2, 5)), 7);
    EXPECT_EQ(axis<3>(1, -1), DVec<3>(0, -1, 0));
}

TEST(DVec, NormalizedWhateverTheScale) {
    for (const double size : {1e-308, 1e-160, 1.0, 1e160, 1e307})
        EXPECT_NEAR(length(normalized(DVec<3>(1, -2, 0.5) * size)), 1, 1e-15) << size;
    EXPECT_EQ(normalized(DVec<2>(0.0)), DVec<2>(1, 0));
    EXPECT_EQ(normalized(DVec<2>(0.0), DVec<2>(0, -1)), DVec<2>(0, -1));
}

TEST(DVec, Perpendicular) {
    oracle::Random random(7);
    for (int repeat = 0; repeat < 1000; ++repeat) {
        const DVec<2> u = random.direction<2>();
        EXPECT_NEAR(cross(u, perpendicular(u)), 1, 1e-15) << "counter-clockwise";
        // Along an axis, between two of them, or anywhere.
        DVec<3> v = random.direction<3>();
        if (random.chance(0.3)) v[static_cast<int>(random.below(3))] = 0;
        if (random.chance(0.3)) v[static_cast<int>(random.below(3))] = v.x;
        if (length(v) == 0) continue;
        const DVec<3> w = perpendicular(v);
        EXPECT_NEAR(length(w), 1, 1e-15);
        EXPECT_NEAR(dot(v, w), 0, 1e-15);
    }
}

TEST(Vec, IsFinite) {
    EXPECT_TRUE(is_finite(Vec2(0, std::numeric_limits<float>::max())));
    EXPECT_FALSE(is_finite(Vec2(0, std::numeric_limits<float>::infinity())));
    EXPECT_FALSE(is_finite(Vec3(0, 0, std::numeric_limits<float>::quiet_NaN())));
}

}  // namespace
}  // namespace abut::test
