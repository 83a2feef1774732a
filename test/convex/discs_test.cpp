// Supports of cylinders and cones along and near their axis, where the perpendicular part of the direction is only
// rounding.

#include <abut/convex/support.hpp>
#include <abut/query/closest.hpp>
#include <abut/shape/cylinder.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

const Cylinder cylinder{{1, 2, 3}, {1, 4, 3.5f}, 0.7f};

TEST(Discs, SupportsAlongTheAxisLieOnTheDisc) {
    const Convex<3> view = convex(cylinder);
    const DVec<3> a(cylinder.a), axis = normalized(DVec<3>(cylinder.b) - a);
    for (const double lean : {0.0, 1e-17, 1e-13, 1e-10, 1e-8, 1e-4})
        for (int i = 0; i < 3; ++i) {
            DVec<3> direction = -axis;
            direction[i] += lean;
            const DVec<3> point = core_support(view, direction).position;
            EXPECT_NEAR(dot(point - a, axis), 0, 1e-12) << "lean " << lean << " along axis " << i;
            EXPECT_LE(length(point - a), 0.7000001) << "lean " << lean << " along axis " << i;
        }
}

// Measured: a point on the rim was reported 0.0494 away, because a support point along the axis left the disc.
TEST(Discs, APointOnTheRimTouches) {
    EXPECT_NEAR(closest(cylinder, Vec3{0.382655263f, 1.91996861f, 3.32012558f}).distance, 0, 1e-6);
}

}  // namespace
}  // namespace abut
