#include "../oracle/is_long.hpp"
#include "../oracle/random.hpp"
#include "analytic.hpp"
#include <abut/field/field.hpp>
#include <abut/field/shadow_ray.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace abut;
using namespace abut::detail;

constexpr float cell = 0.05f;

/// A ball, a box and a thin wall above a floor.
oracle::Analytic<3> scene() {
    const auto ball = oracle::ball<3>({-0.8, 0.1, 0.2}, 0.4), box = oracle::box<3>({0.6, 0.5, 0}, {0.3, 0.25, 0.4}),
               wall = oracle::box<3>({0.1, 0.4, -0.9}, {0.5, 0.3, 0.06}),
               floor = oracle::box<3>({0, -0.6, 0}, {2, 0.2, 2});
    return {[=](const DVec<3>& p) {
                return std::min({ball.distance(p), box.distance(p), wall.distance(p), floor.distance(p)});
            },
            {{-2, -0.8f, -2}, {2, 0.75f, 2}}};
}

const Field3& scene_field() {
    static const Field3 field(oracle::filled_around(scene(), cell, 5, {.store = FieldStore::sparse}));
    return field;
}

/// The minimum of clearance / distance along the ray, by small steps; 0 if the ray hits.
template <int D>
double min_slope(const oracle::Analytic<D>& solid, const DVec<D>& from, const DVec<D>& to, double start) {
    const double distance_to_light = length(to - from);
    double result = 1e300;
    for (double t = std::min(start, distance_to_light); t < distance_to_light; t += 0.002) {
        const double clear = solid.distance(from + (to - from) * (t / distance_to_light));
        if (clear <= 0) return 0;
        result = std::min(result, clear / t);
    }
    return std::min(result, solid.distance(to) / distance_to_light);
}
double smooth(double share) {
    const double s = std::clamp(share, 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

struct Question {
    Vec3 point, light;
};
/// Points above the floor and lights in the air, none within a solid.
std::vector<Question> questions(std::uint64_t seed, int count) {
    oracle::Random random(seed);
    const auto solid = scene();
    std::vector<Question> result;
    while (result.size() < static_cast<std::size_t>(count)) {
        Vec3 p, q;
        for (int i = 0; i < 3; ++i) {
            p[i] = random.uniform_float(-1.8, 1.8);
            q[i] = random.uniform_float(-1.8, 1.8);
        }
        p.y = random.uniform_float(-0.4, 0.2);
        q.y = random.uniform_float(0.3, 2.2);  // above the volume too
        if (solid.distance(DVec<3>(p)) > 0.01 && solid.distance(DVec<3>(q)) > 0.2) result.push_back({p, q});
    }
    return result;
}

TEST(FieldShadow, HardOnesAreWhatARaySays) {
    int lit = 0, dark = 0;
    for (const Question& q : questions(3, 2000)) {
        const double least = min_slope(scene(), DVec<3>(q.point), DVec<3>(q.light), static_cast<double>(cell));
        const float shadow_value = scene_field().shadow(q.point, q.light, 0);
        ASSERT_TRUE(shadow_value == 0 || shadow_value == 1);
        // A ray that passes closer than a cell may hit or miss.
        const double distance_to_light = length(DVec<3>(q.light) - DVec<3>(q.point));
        if (least == 0) {
            double depth = 0;
            for (double t = static_cast<double>(cell); t < distance_to_light; t += 0.002)
                depth = std::min(depth, scene().distance(DVec<3>(q.point) + (DVec<3>(q.light) - DVec<3>(q.point)) *
                                                                                (t / distance_to_light)));
            if (depth < -0.5 * static_cast<double>(cell)) {
                ++dark;
                EXPECT_EQ(shadow_value, 0);
            }
        } else if (least * distance_to_light > static_cast<double>(cell)) {
            ++lit;
            EXPECT_EQ(shadow_value, 1);
        }
    }
    EXPECT_GT(lit, 400);
    EXPECT_GT(dark, 400);
}

TEST(FieldShadow, StepsFindTheLeastSlope) {
    double sum = 0, most = 0;
    int between = 0;
    std::vector<double> errors;
    for (const Question& q : questions(5, oracle::is_long() ? 20000 : 2000)) {
        const double least = min_slope(scene(), DVec<3>(q.point), DVec<3>(q.light), static_cast<double>(cell));
        const double right = smooth(least / 0.2);
        const double off = std::abs(static_cast<double>(scene_field().shadow(q.point, q.light, 0.2f)) - right);
        if (right == 0 || right == 1) {
            EXPECT_LT(off, 0.15);
            continue;
        }
        errors.push_back(off);
        sum += off;
        most = std::max(most, off);
        ++between;
    }
    std::sort(errors.begin(), errors.end());
    std::cout << "in the penumbra: " << between << ", off by " << sum / between << " on average, 95 % "
              << errors[errors.size() * 95 / 100] << ", at most " << most << "\n";
    EXPECT_GT(between, 200);
    EXPECT_LT(sum / between, 0.016);
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.05);
}

/// The visible share of a disc around the light, perpendicular to the ray.
double seen_of_disc(const oracle::Analytic<3>& solid, const DVec<3>& from, const DVec<3>& light, double radius) {
    const DVec<3> to_light = light - from, side = perpendicular(to_light), up = cross(normalized(to_light), side);
    constexpr int rings = 12;
    int seen = 0, all = 0;
    for (int i = -rings; i <= rings; ++i)
        for (int j = -rings; j <= rings; ++j) {
            const double x = i / (rings + 0.5), y = j / (rings + 0.5);
            if (x * x + y * y > 1) continue;
            ++all;
            const DVec<3> to = light + (side * x + up * y) * radius;
            const double total = length(to - from);
            double t = static_cast<double>(cell), clear = 1;
            while (t < total && clear > 0) {
                clear = solid.distance(from + (to - from) * (t / total));
                t += std::max(clear, 0.004);
            }
            seen += clear > 0;
        }
    return static_cast<double>(seen) / all;
}

TEST(FieldShadow, BesideADiscOfLight) {
    // The shadow uses the lit half of the penumbra only: it is darker than the true one, by a half at its edge. It is
    // lighter only by the error of the steps and where several solids cover the light together.
    double sum = 0, lighter = 0, darker = 0;
    int between = 0, far_off = 0;
    const std::vector<Question> all = questions(7, 700);
    for (const Question& q : all) {
        constexpr float softness = 0.1f;
        const DVec<3> from(q.point), light(q.light);
        const double true_share =
            seen_of_disc(scene(), from, light, static_cast<double>(softness) * length(light - from));
        const double shadow_value = static_cast<double>(scene_field().shadow(q.point, q.light, softness));
        between += true_share > 0 && true_share < 1;
        sum += std::abs(shadow_value - true_share);
        lighter = std::max(lighter, shadow_value - true_share);
        darker = std::max(darker, true_share - shadow_value);
        far_off += shadow_value > true_share + 0.1;
    }
    std::cout << "in the true penumbra: " << between << ", off by " << sum / static_cast<double>(all.size())
              << " on average, lighter by up to " << lighter << ", darker by up to " << darker << "\n";
    EXPECT_GT(between, 100);
    EXPECT_LT(darker, 0.75);
    EXPECT_LT(sum / static_cast<double>(all.size()), 0.1);
    EXPECT_LT(far_off, 7);
}

TEST(FieldShadow, SofterIsNeverLighter) {
    for (const Question& q : questions(9, 500)) {
        float before = 1;
        for (const float softness : {0.0f, 0.001f, 0.01f, 0.03f, 0.1f, 0.4f, 2.0f, 100.0f}) {
            const float shadow_value = scene_field().shadow(q.point, q.light, softness);
            ASSERT_LE(shadow_value, before);
            ASSERT_GE(shadow_value, 0);
            before = shadow_value;
        }
    }
}

TEST(FieldShadow, WhereTheLightOrThePointIsWithin) {
    const Field3 field(oracle::filled_around(oracle::ball<3>({0, 0, 0}, 1), cell, 4));
    EXPECT_EQ(field.shadow({0, 0, 0}, {3, 0, 0}), 0);  // deep within
    EXPECT_EQ(field.shadow({3, 0, 0}, {0, 0, 0}), 0);  // the light is
    EXPECT_EQ(field.shadow({3, 0, 0}, {0.99f, 0, 0}), 0);
    EXPECT_EQ(field.shadow({0, 0, 0}, {0, 0, 0}), 0);  // both
    EXPECT_EQ(field.shadow({2, 0, 0}, {2, 0, 0}), 1);  // in the same place, free
    EXPECT_EQ(field.shadow({1, 0, 0}, {3, 0, 0}), 1);  // on the surface, on either side of it by a little
    EXPECT_EQ(field.shadow({0.97f, 0, 0}, {3, 0, 0}), 1);
    EXPECT_EQ(field.shadow({0.9f, 0, 0}, {3, 0, 0}), 0);   // no more
    EXPECT_EQ(field.shadow({-1, 0, 0}, {3, 0, 0}), 0);     // on the far side
    EXPECT_EQ(field.shadow({1, 0, 0}, {1.02f, 0, 0}), 1);  // a light nearer than a cell
    // Far outside of the volume, through it and past it.
    EXPECT_EQ(field.shadow({-1e6f, 0, 0}, {1e6f, 0, 0}, 0), 0);
    EXPECT_EQ(field.shadow({-1e6f, 3, 0}, {1e6f, 3, 0}, 0), 1);
    EXPECT_EQ(field.shadow({1e30f, 0, 0}, {0, 1e30f, 0}, 0), 1);
    EXPECT_EQ(field.shadow({3, 0, 0}, {1e30f, 0, 0}), 1);
    // A penumbra that lies outside of the volume.
    const float beside = field.shadow({-3, 1.3f, 0}, {3, 1.3f, 0}, 0.2f);
    EXPECT_NEAR(beside, smooth(0.3 / 3 / 0.2), 0.15);  // from a lower bound: darker
}

TEST(FieldShadow, WhatIsACellAwayCasts) {
    const Field2 field(oracle::filled_around(oracle::box<2>({0.1, 0}, {0.03, 0.5}), cell, 6));
    EXPECT_EQ(field.shadow({0, 0}, {0.25f, 0}, 0), 0);
    EXPECT_EQ(field.shadow({0.25f, 0.1f}, {0, 0}), 0);
    EXPECT_EQ(field.shadow({0, 0}, {0, 0.3f}, 0), 1);  // along it
}

TEST(FieldShadow, StepsHaveABound) {
    // Slightly above the surface everywhere: the shortest steps possible.
    FieldData<2> data;
    data.cells = {40, 40};
    data.cell = 0.1f;
    data.surface = {{0, 0}, {4, 4}};
    data.distance.assign(41 * 41, 1e-6f);
    const Field2 field(data);
    const auto places = [&](std::uint32_t limit) {
        ShadowRay<2> walk(field.data(), {0, 0.01f}, {4, 0.01f});
        if (limit > 0) walk.limit(limit);
        int result = 0;
        for (; walk.is_running(); ++result) walk.advance(field.distance(walk.place()));
        EXPECT_GT(walk.light(0), 0);
        return result;
    };
    EXPECT_NEAR(places(0), 80, 4);
    EXPECT_EQ(places(10), 12);  // the point and the light come first; what is farther counts as free
}

TEST(FieldShadow, ManyAtOnceAreTheSame) {
    std::vector<Vec3> points, normals;
    for (const Question& q : questions(11, 333)) {
        points.push_back(q.point);
        normals.push_back(scene_field().sample(q.point).normal);
    }
    std::vector<float> shadows(points.size()), occlusions(points.size());
    for (const float softness : {0.0f, 0.1f}) {
        scene_field().shadow(points, {0.5f, 2, 0.3f}, softness, shadows);
        for (std::size_t i = 0; i < points.size(); ++i)
            ASSERT_EQ(shadows[i], scene_field().shadow(points[i], {0.5f, 2, 0.3f}, softness));
    }
    for (const float reach : {0.0f, 0.4f}) {
        scene_field().ambient_occlusion(points, normals, reach, occlusions);
        for (std::size_t i = 0; i < points.size(); ++i)
            ASSERT_EQ(occlusions[i], scene_field().ambient_occlusion(points[i], normals[i], reach));
    }
}

TEST(FieldShadow, Openness) {
    const Field3& field = scene_field();
    const Vec3 up(0, 1, 0);
    EXPECT_EQ(field.ambient_occlusion({-1.5f, -0.4f, 1.5f}, up, 0), 1);
    EXPECT_NEAR(field.ambient_occlusion({-1.5f, -0.4f, 1.5f}, up, 0.3f), 1, 1e-3);  // a floor alone
    EXPECT_EQ(field.ambient_occlusion({-1.5f, -0.6f, 1.5f}, {1, 0, 0}, 0.3f), 0);   // within it
    EXPECT_EQ(field.ambient_occlusion({-1.5f, -0.4f, 1.5f}, -up, 0.3f), 0);         // and into it
    // Under the ball: less with a longer reach, and less near the ball than far from it.
    const Vec3 under(-0.8f, -0.4f, 0.2f), beside(-0.4f, -0.4f, 0.6f);
    EXPECT_LT(field.ambient_occlusion(under, up, 0.15f), field.ambient_occlusion(under, up, 0.05f));
    EXPECT_LT(field.ambient_occlusion(under, up, 0.3f), field.ambient_occlusion(beside, up, 0.3f));
    EXPECT_LT(field.ambient_occlusion(beside, up, 0.5f), 0.999f);
    // In the corner of floor and wall: of a height h, min(h, x) is free at distance x from the wall.
    const Field2 corner(oracle::filled_around(
        oracle::Analytic<2>{[](const DVec<2>& p) { return std::min(p.x, p.y); }, {{-1, -1}, {4, 4}}}, 0.1f, 1));
    for (const float x : {0.2f, 0.5f, 1.0f, 2.0f}) {
        double sum = 0, weights = 0;
        for (int i = 1; i <= 5; ++i) {
            const double height = 0.2 * i, weight = std::ldexp(1.0, -i);
            sum += weight * std::min(1.0, static_cast<double>(x) / height);
            weights += weight;
        }
        EXPECT_NEAR(corner.ambient_occlusion({x, 0}, {0, 1}, 1), sum / weights, 1e-3) << x;
    }
}

}  // namespace
