// Distance functions at the limits: searches that reach their iteration limit, functions that violate their contract,
// unbounded shapes. Every query ends with a valid answer.

#include "../oracle/random.hpp"
#include "user_functions.hpp"
#include <abut/query/certify.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/detail/sdf/minimum.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/placed.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace users {

/// A function that violates the contract of a distance function.
struct Liar {
    int kind = 0;
};
Aabb3 bounds(const Liar&) {
    return {Vec3(-1.0f), Vec3(1.0f)};
}
float signed_distance(const Liar& liar, const Vec3& point) {
    switch (liar.kind) {
        case 0:
            return std::numeric_limits<float>::quiet_NaN();
        case 1:
            return std::numeric_limits<float>::infinity();
        case 2:
            return -std::numeric_limits<float>::infinity();
        case 3:
            return 0;
        case 4:
            return 1000 * (point.x + point.y * point.z);
        default: {
            const float sum = point.x * 12.9898f + point.y * 78.233f + point.z * 37.719f;
            return 10 * (sum * 43.7f - std::floor(sum * 43.7f) - 0.5f);
        }
    }
}

/// A function that is positive everywhere.
struct Nothing {};
Aabb3 bounds(const Nothing&) {
    return Aabb3::empty();
}
float signed_distance(const Nothing&, const Vec3&) {
    return std::numeric_limits<float>::infinity();
}

}  // namespace users

namespace {

/// A search that stops at its limit returns a valid bound, with its uncertainty.
TEST(FunctionLimits, BoundOnBoxesReached) {
    const users::Brick<3> brick;
    const DistanceFunction<3> function = view(brick);
    const PlacedFunction<3> seen(function);
    Pose3 pose{{1.6f, 1.7f, 1.8f}, {0.8f, 0.4f, 0.4f, 0.2f}};
    const auto box = at(Box3{Vec3(0.0f), Vec3(0.5f)}, pose);
    MinimumOptions<3> options;
    options.tolerance = 1e-6;
    options.max_boxes = 4000;
    const Minimum<3> whole = minimum_in_convex(seen, view(box), options);
    EXPECT_LT(whole.boxes, 4000);
    options.max_boxes = 4;
    const Minimum<3> cut = minimum_in_convex(seen, view(box), options);
    EXPECT_LE(cut.boxes, 5);
    EXPECT_GT(cut.uncertainty, 0);
    EXPECT_GE(cut.distance, whole.distance - 1e-3);
    EXPECT_LT(cut.distance, whole.distance + 0.5);
    options.max_boxes = 6;
    const Minimum<3> low = lowest_inside(seen, bounds(brick), normalized(DVec<3>(1, 2, 3)), 1e-6, options);
    EXPECT_LE(low.distance, 0);
}

TEST(FunctionLimits, BrokenPromisesEnd) {
    for (int kind = 0; kind < 6; ++kind) {
        SCOPED_TRACE(testing::Message() << "kind " << kind);
        const users::Liar liar{kind};
        const Box3 box{{0.5f, 0.5f, 0.5f}, Vec3(1.0f)};
        const HalfSpace3 ground{{0, 1, 0}, 0};
        const auto check = [](const Vec3& normal) { EXPECT_NEAR(length(DVec<3>(normal)), 1, 1e-5); };
        check(closest(liar, box).normal);
        check(closest(liar, ground).normal);
        check(closest(liar, users::Liar{kind}).normal);
        check(contact(box, liar).normal);
        overlaps(liar, box);
        contains(liar, Vec3(0.0f));
        certify(box, liar, closest(box, liar));
        for (const Vec3& displacement : {Vec3(-3, 0, 0), Vec3(-3, 1, 2)}) {
            if (const auto hit = raycast(Ray3::between(Vec3(2, 0.1f, 0.1f), Vec3(2, 0.1f, 0.1f) + displacement), liar))
                check(hit->normal);
            if (const auto hit = sweep(Box3{{3, 0, 0}, Vec3(0.5f)}, displacement, liar)) check(hit->normal);
            if (const auto hit =
                    sweep(box, Pose3{{3, 0, 0}}, Pose3{displacement, {0.8f, 0.6f, 0, 0}}, liar, Pose3{}, Pose3{}))
                check(hit->normal);
        }
    }
}

TEST(FunctionLimits, NothingIsNowhere) {
    const users::Nothing nothing;
    const Box3 box{Vec3(0.0f), Vec3(1.0f)};
    EXPECT_TRUE(std::isinf(closest(nothing, box).distance));
    EXPECT_TRUE(std::isinf(closest(box, nothing).distance));
    EXPECT_TRUE(std::isinf(closest(nothing, users::Brick<3>()).distance));
    EXPECT_FALSE(overlaps(nothing, box));
    EXPECT_FALSE(contact(box, nothing));
    EXPECT_FALSE(contains(nothing, Vec3(0.0f)));
    EXPECT_FALSE(raycast(Ray3{{-5, 0, 0}, {1, 0, 0}}, nothing));
    EXPECT_FALSE(sweep(box, Vec3(5, 0, 0), nothing));
}

/// A ray along the ground over a million hills.
TEST(FunctionLimits, LongWays) {
    const users::Hills<3> hills{0.2f};
    const Ray3 level{{0, 0.45f, 0}, {1, 0, 0}, 1e6f};
    EXPECT_FALSE(raycast(level, hills));
    const auto slanted = raycast(Ray3{{0, 50, 0}, to_float(normalized(DVec<3>(1, -1e-3, 0)))}, hills);
    ASSERT_TRUE(slanted);
    EXPECT_NEAR(signed_distance(hills, slanted->point), 0, 0.02f);
    EXPECT_FALSE(sweep(Box3{{0, 2, 0}, Vec3(0.5f)}, Vec3(1e5f, 0, 0), hills));
    const auto falls = sweep(Box3{{0, 1000, 0}, Vec3(0.5f)}, Vec3(0, -2000, 0), hills);
    ASSERT_TRUE(falls);
    EXPECT_NEAR(falls->distance, 999.4f, 0.2f);
    // The ray has infinite length.
    const auto down = raycast(Ray3{{0, 3, 0}, {0, -1, 0}}, hills);
    ASSERT_TRUE(down);
    EXPECT_NEAR(down->distance, 3, 1e-4f);
}

/// Swapping two functions gives the same distance and the opposite normal.
TEST(FunctionLimits, TwoFunctionsChangePlaces) {
    oracle::Random random(41);
    int apart = 0;
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 41, pair " << i);
        Pose3 pose;
        pose.rotation = random.rotation<3>();
        pose.position = to_float(random.direction<3>() * random.uniform(1, 3.5));
        const users::Blob<3> blob{{0, 0, 0}, random.uniform_float(0.5, 1.2)};
        const users::Brick<3> brick{Vec3(random.uniform_float(0.3, 1))};
        const auto there = at(brick, pose);
        const auto found = closest(blob, there), turned = closest(there, blob), truth = closest(blob.twin(), there);
        EXPECT_NEAR(found.distance, turned.distance, 2e-3f);
        if (found.distance > 0.01f) {
            ++apart;
            EXPECT_NEAR(found.distance, truth.distance, 2e-3f);
            EXPECT_NEAR(dot(DVec<3>(found.normal), DVec<3>(turned.normal)), -1, 1e-2);
        }
        EXPECT_NEAR(length(DVec<3>(found.on_b) - DVec<3>(found.on_a)), std::abs(static_cast<double>(found.distance)),
                    1e-5);
    }
    EXPECT_GT(apart, 15);
    EXPECT_LT(apart, 50);
}

}  // namespace
}  // namespace abut
