// The closed form of capsules that move straight at capsules and triangles in space, against conservative advancement,
// which a trace selects. Capsules lie in the plane of the triangle, along its edges, or across it.

#include "../../oracle/random.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/triangle.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

struct SweepCounts {
    int hits = 0, misses = 0, faces = 0, edges = 0, vertices = 0;
};

Capsule3 moved_by(const Capsule3& capsule, const Vec3& by) {
    return {capsule.a + by, capsule.b + by, capsule.radius};
}
Triangle3 moved_by(const Triangle3& triangle, const Vec3& by) {
    return {triangle.a + by, triangle.b + by, triangle.c + by};
}

template <class A, class B>
void expect_advancement_agrees(const A& a, const Vec3& motion, const B& b, double size, SweepCounts& counts) {
    Trace<3> trace;
    const auto found = sweep(a, motion, b), searched = sweep(a, motion, b, {.trace = &trace});
    const double tolerance = 2e-5 * size, long_motion = length(DVec<3>(motion));
    if (found.has_value() != searched.has_value()) {
        // A graze may go either way.
        double deepest = std::numeric_limits<double>::infinity();
        for (int i = 0; i <= 1000; ++i)
            deepest = std::min(
                deepest,
                static_cast<double>(closest(moved_by(a, motion * (0.001f * static_cast<float>(i))), b).distance));
        EXPECT_GE(deepest, -tolerance);
        return;
    }
    ++(found ? counts.hits : counts.misses);
    if (!found || found->fraction == 0) return;
    const DVec<3> normal(found->normal);
    EXPECT_NEAR((found->fraction - searched->fraction) * -dot(normal, DVec<3>(motion)), 0, tolerance);
    const Closest<3> there = closest(moved_by(a, motion * found->fraction), b);
    EXPECT_NEAR(there.distance, 0, tolerance + 1e-7 * long_motion);
    EXPECT_LT(dot(normal, DVec<3>(motion)), 0);
    const auto distance_to = [&](const auto& shape) {
        return static_cast<double>(closest(shape, found->point).distance);
    };
    EXPECT_NEAR(distance_to(b), 0, tolerance + 1e-7 * long_motion) << "the point isn't on the shape at rest";
    EXPECT_NEAR(distance_to(moved_by(a, motion * found->fraction)), 0, tolerance + 1e-7 * long_motion)
        << "the point isn't on the mover";
    counts.faces += found->feature.kind == FeatureKind::face ? 1 : 0;
    counts.edges += found->feature.kind == FeatureKind::edge ? 1 : 0;
    counts.vertices += found->feature.kind == FeatureKind::vertex ? 1 : 0;
}

TEST(CapsuleSweep, AgreesWithAdvancement) {
    oracle::Random random(3);
    SweepCounts at_triangles, of_triangles, of_capsules;
    for (int i = 0; i < 3000; ++i) {
        SCOPED_TRACE(i);
        const double size = random.power_of_two(-6, 6);
        const auto place = [&](double reach) { return to_float(random.in_cube<3>() * (reach * size)); };
        Triangle3 triangle{place(1), place(1), place(1)};
        if (i % 3 == 0) triangle.a.z = triangle.b.z = triangle.c.z = 0;
        // Every seventh capsule starts near the triangle, and many of these in it.
        const Vec3 middle =
            i % 7 == 0 ? triangle.a * 0.4f + triangle.b * 0.3f + triangle.c * 0.3f + place(0.2) : place(4);
        Vec3 half = place(0.5);
        if (i % 5 == 1) half = (triangle.b - triangle.a) * 0.4f;
        if (i % 5 == 2) half = (triangle.b - triangle.a) * 0.4f + (triangle.c - triangle.b) * 0.3f;
        if (i % 5 == 3) half.x = half.y = 0;
        const Capsule3 capsule{middle - half, middle + half,
                               random.uniform_float(0.05, 0.5) * static_cast<float>(size)};
        const Vec3 motion =
            ((triangle.a + triangle.b + triangle.c) * (1 / 3.0f) - middle + place(0.7)) * (i % 14 == 7 ? -1.5f : 1.5f);
        expect_advancement_agrees(capsule, motion, triangle, size, at_triangles);
        expect_advancement_agrees(triangle, -motion, capsule, size, of_triangles);
        const Capsule3 other{triangle.a, triangle.b, 0.1f * static_cast<float>(size)};
        expect_advancement_agrees(capsule, motion, other, size, of_capsules);
    }
    for (const SweepCounts& counts : {at_triangles, of_triangles, of_capsules}) {
        EXPECT_GT(counts.hits, 800);
        EXPECT_GT(counts.misses, 500);
        EXPECT_GT(counts.edges, 200);
        EXPECT_GT(counts.vertices, 200);
    }
    EXPECT_GT(at_triangles.faces, 200);
}

TEST(CapsuleSweep, OfALyingCapsuleOntoAFloorTouchesBetweenItsEnds) {
    const Triangle3 edge_up{{0, -1, 0}, {0, 1, 0}, {0, 0, -1}};
    const auto hit = sweep(Capsule3{{-2, 0.25f, 3}, {1, 0.25f, 3}, 0.5f}, Vec3(0, 0, -10), edge_up);
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->distance, 2.5f);
    EXPECT_EQ(hit->point, Vec3(0, 0.25f, 0));
    EXPECT_EQ(hit->normal, Vec3(0, 0, 1));
    EXPECT_EQ(hit->feature, (Feature{0, edge_index(0, 1), FeatureKind::edge}));
    const auto back = sweep(edge_up, Vec3(0, 0, 10), Capsule3{{-2, 0.25f, 3}, {1, 0.25f, 3}, 0.5f});
    ASSERT_TRUE(back);
    EXPECT_FLOAT_EQ(back->distance, 2.5f);
    EXPECT_EQ(back->point, Vec3(0, 0.25f, 2.5f));
    EXPECT_EQ(back->feature, (Feature{0, edge_index(0, 1), FeatureKind::edge}));
}

}  // namespace

}  // namespace abut::test
