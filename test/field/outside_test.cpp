// Points outside of the volume, and invalid points.

#include "analytic.hpp"
#include <abut/field/field.hpp>
#include <abut/field/quantise.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using namespace oracle;

template <int D>
void expect_bound(const Analytic<D>& solid, float cell, FieldStore store, bool quantised) {
    FillOptions options;
    options.store = store;
    FieldData<D> data = filled_around<D>(solid, cell, 2, options);
    if (quantised) quantise(data);
    const Field<D> field(data);
    const Aabb<D> volume = field.volume();
    Random random(17);
    double worst = 0;
    int outside = 0;
    for (int i = 0; i < 20000; ++i) {
        const double reach = random.power_of_two(-6, 6);
        Vec<D> point;
        for (int a = 0; a < D; ++a)
            point[a] = random.uniform_float(static_cast<double>(volume.min[a]) - reach,
                                            static_cast<double>(volume.max[a]) + reach);
        if (contains(volume, point)) continue;
        ++outside;
        const double right = solid.distance(DVec<D>(point));
        const FieldSample<D> found = field.sample(point);
        ASSERT_EQ(found.distance, field.distance(point));
        ASSERT_LE(static_cast<double>(found.distance), right);
        ASSERT_GT(found.distance, 0);
        ASSERT_NEAR(length(DVec<D>(found.normal)), 1, 1e-6);
        worst = std::max(worst, right - static_cast<double>(found.distance));
        // Far away the distance is as good as that to the solid's box, and the normal is the solid's own to a few
        // cells.
        if (right > 40 * static_cast<double>(cell)) {
            ASSERT_GT(dot(DVec<D>(found.normal), solid.gradient(DVec<D>(point))), 0.95);
        }
    }
    EXPECT_GT(outside, 5000);
    EXPECT_GT(worst, 0);
}

TEST(FieldOutside, NothingIsNearerThanReported) {
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse})
        for (const bool quantised : {false, true}) {
            expect_bound<2>(ball<2>({1, 2}, 3), 0.25f, store, quantised);
            expect_bound<2>(box<2>({-1, 0.5}, {2, 1}), 0.1f, store, quantised);
            expect_bound<3>(ball<3>({1, 2, -3}, 3), 0.25f, store, quantised);
            expect_bound<3>(box<3>({10, 0.5, 7}, {2, 1, 3}), 0.25f, store, quantised);
            expect_bound<3>(torus({0, 0, 0}, 2, 1), 0.25f, store, quantised);
            expect_bound<3>(turned(box<3>({1, 0, 0}, {2, 1, 0.5}), {1, 2, 3}, {0, 1, 0}), 0.25f, store, quantised);
        }
}

/// Sphere tracing towards the solid, by steps of the distance: it arrives, and passes through nothing.
TEST(FieldOutside, StepsByTheDistanceArrive) {
    const Analytic<3> solid = turned(box<3>({1, 0, 0}, {2, 1, 0.5}), {1, 2, 3}, {0, 1, 0});
    const Field3 field(filled_around<3>(solid, 0.125f, 2));
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        const DVec<3> start = random.direction<3>() * random.uniform(5, 50);
        const DVec<3> toward = normalized(DVec<3>(center(solid.surface)) - start);
        double along = 0;
        int steps = 0;
        for (; steps < 100; ++steps) {
            const Vec3 point = to_float<3>(start + toward * along);
            const auto distance = static_cast<double>(field.distance(point));
            ASSERT_GT(distance, -0.05);
            if (distance < 1e-3) break;
            along += distance;
        }
        ASSERT_LT(steps, 60);
        ASSERT_LT(std::abs(solid.distance(start + toward * along)), 0.1);
    }
}

/// A solid that the volume cuts ends at the volume.
TEST(FieldOutside, CutByTheVolume) {
    const Analytic<3> ground = box<3>({0, -10, 0}, {100, 10, 100});
    const Field3 field(filled<3>(ground, {-4, -4, -4}, 0.5f, glm::uvec3(16)));
    EXPECT_NEAR(field.distance({3, 10, 3}), 10, 1e-4);
    EXPECT_NEAR(field.distance({0, -9, 0}), 5, 1e-4);
    EXPECT_NEAR(field.distance({10, -1, 0}), 6, 1e-4);
    EXPECT_NEAR(field.distance({10, 2, 0}), std::sqrt(36.0 + 4), 0.5);
    EXPECT_LT(field.distance({3.9f, -1, 0}), 0);
    EXPECT_EQ(bounds(field), (Aabb3{{-4, -4, -4}, {4, bounds(field).max.y, 4}}));
    EXPECT_NEAR(bounds(field).max.y, 0, 1e-4);
}

/// Everything but a bubble is solid: outside of the volume too.
TEST(FieldOutside, SolidAllAround) {
    const Analytic<3> bubble = ball<3>({0, 0, 0}, 1);
    const Analytic<3> around{[=](const DVec<3>& p) { return -bubble.distance(p); }, bubble.surface};
    const Field3 field(filled_around<3>(around, 0.125f, 2));
    EXPECT_LT(field.distance({5, 1, 0}), -3.5f);
    EXPECT_GE(field.distance({5, 1, 0}), -4.11f);
    EXPECT_LT(field.sample({5, 0, 0}).normal.x, -0.99f);
}

TEST(FieldOutside, WhatIsNoPointIsInfinitelyFar) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
#ifndef NDEBUG
    GTEST_SKIP() << "asserted here";
#endif
    const Field3 field(filled_around<3>(ball<3>({0, 0, 0}, 1), 0.25f, 2));
    for (int a = 0; a < 3; ++a)
        for (const float bad : {nan, infinity, -infinity}) {
            Vec3 point(0.5f);
            point[a] = bad;
            EXPECT_EQ(field.distance(point), infinity);
            EXPECT_EQ(field.sample(point).distance, infinity);
            EXPECT_NEAR(length(DVec<3>(field.sample(point).normal)), 1, 1e-6);
            EXPECT_TRUE(is_finite<3>(field.closest(point)));
        }
    // Up to the limits of floats.
    for (const float far : {1e10f, 1e20f, 3e38f, -3e38f}) {
        const FieldSample<3> sample = field.sample({far, far, far});
        EXPECT_GT(sample.distance, 1e10f);
        EXPECT_FALSE(std::isnan(sample.distance));
        EXPECT_NEAR(length(DVec<3>(sample.normal)), 1, 1e-6);
    }
}

TEST(FieldOutside, AMillionPointsAnywhereAreNumbers) {
    FillOptions options;
    options.store = FieldStore::sparse;
    const Field3 field(filled_around<3>(torus({0, 0, 0}, 2, 1), 0.25f, 2, options));
    Random random(99);
    for (int i = 0; i < 1000000; ++i) {
        Vec3 point;
        for (int a = 0; a < 3; ++a) point[a] = static_cast<float>(random.uniform(-1, 1) * random.power_of_two(-8, 8));
        const FieldSample<3> sample = field.sample(point);
        const double square = length_squared(DVec<3>(sample.normal));
        ASSERT_TRUE(std::isfinite(sample.distance) && std::abs(square - 1) < 1e-6);
    }
}

}  // namespace
}  // namespace abut
