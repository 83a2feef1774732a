// Rays and sweeps of solids: entries alone are hits, whether the start is outside, on the surface or inside.

#include "../../oracle/is_long.hpp"
#include "../../shape/meshes.hpp"
#include "solid_pairs.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/intersection.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polyhedron.hpp>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

void expect_same_hit(const std::optional<Hit<3>>& hit, const std::optional<Hit<3>>& expected) {
    ASSERT_EQ(hit.has_value(), expected.has_value());
    if (!hit) return;
    EXPECT_NEAR(hit->fraction, expected->fraction, 2e-5);
    EXPECT_NEAR(hit->distance, expected->distance, 2e-4);
    EXPECT_EQ(hit->started_inside, expected->started_inside);
    EXPECT_GT(glm::dot(hit->normal, expected->normal), 0.99f);
}

/// A box as a solid mesh, at a place between the corners of its faces' triangles.
const Vec3 half(1.25f, 0.75f, 1);

TEST(SolidMotion, RaysOfABoxAreThoseOfTheBox) {
    constexpr std::uint64_t seed = 20291;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Mesh mesh = box_surface(-half, half).mesh(), inwards = reversed(box_surface(-half, half)).mesh();
    int hits = 0, inside = 0;
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE(i);
        const Pose3 pose{detail::to_float(random.in_cube<3>()), random.rotation<3>()};
        const Box3 box{pose.position, half, pose.rotation};
        const auto ray =
            Ray3::between(detail::to_float(random.in_cube<3>() * 2.0), detail::to_float(random.in_cube<3>() * 2.0));
        // Near the middle of the box two faces are equally far.
        const Closest<3> start = closest(box, ray.origin),
                         other = closest(at(solid(mesh), pose), Sphere{ray.origin, 0});
        ASSERT_NEAR(start.distance, other.distance, 1e-4);
        if (start.distance < 0 && glm::dot(start.normal, other.normal) < 0.9f) continue;
        const std::optional<Hit<3>> expected = raycast(ray, box);
        expect_same_hit(raycast(ray, at(solid(mesh), pose)), expected);
        expect_same_hit(raycast(ray, at(solid(inwards), pose)), expected);
        expect_same_hit(raycast(ray, at(stretched(solid(mesh), Vec3(-1, 1, 1)), pose)), expected);
        if (expected) ++hits;
        if (start.distance < 0) ++inside;
    }
    EXPECT_GT(hits, 400);
    EXPECT_GT(inside, 100);
}

TEST(SolidMotion, RaysThatStartOnTheSurface) {
    const Mesh box = box_surface({0, 0, 0}, {4, 4, 4}).mesh();
    const auto cast = [&](const Vec3& from, const Vec3& along) { return raycast(Ray3{from, along, 100}, solid(box)); };
    const std::optional<Hit<3>> in = cast({1, 1.5f, 4}, {0, 0, -1});
    ASSERT_TRUE(in);
    EXPECT_EQ(in->fraction, 0);
    EXPECT_EQ(in->normal, Vec3(0, 0, 1));
    EXPECT_FALSE(in->started_inside);
    EXPECT_FALSE(cast({1, 1.5f, 4}, {0, 0, 1}));
    EXPECT_FALSE(cast({1, 1.5f, 4}, {1, 0, 0}));
    EXPECT_GT(raycast(Ray3{{1, 1.5f, 4}, {0, 0, -1}, 100}, box)->fraction, 0) << "the triangles alone";
}

TEST(SolidMotion, RaysLeaveAndEnterAgain) {
    // From one arm of a U into the other one.
    const Mesh u = mesh_of(scenes::kit()[2]);
    const std::optional<Hit<3>> hit = raycast(Ray3{{0.875f, 1.5f, 0.5f}, {1, 0, 0}, 10}, solid(u));
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->distance, 1.125f);
    EXPECT_EQ(hit->normal, Vec3(-1, 0, 0));
    EXPECT_FALSE(hit->started_inside);
    // Two boxes that overlap: the front of the second one is inside of the first one.
    const Mesh boxes = joined(box_surface({0, 0, 0}, {4, 4, 4}), box_surface({3, 1, 1}, {6, 3, 3})).mesh();
    EXPECT_FALSE(raycast(Ray3{{2.5f, 3.75f, 2}, glm::normalize(Vec3(1, 0.01f, 0)), 10}, solid(boxes)));
    EXPECT_FALSE(raycast(Ray3{{2.5f, 1.875f, 3.9375f}, Vec3(0, 0, 1), 10}, solid(boxes)));
    const Mesh near = joined(box_surface({0, 0, 0}, {4, 4, 4}), box_surface({3, 1, 3}, {6, 3, 5})).mesh();
    const std::optional<Hit<3>> out = raycast(Ray3{{3.5f, 2, 2.25f}, Vec3(0.6f, 0, 0.8f), 10}, solid(near));
    ASSERT_TRUE(out) << "below the second box";
    EXPECT_FLOAT_EQ(out->distance, 0.9375f);
    EXPECT_EQ(out->normal, Vec3(0, 0, -1));
}

TEST(SolidMotion, ContainsIsThatOfTheMesh) {
    constexpr std::uint64_t seed = 20292;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    for (const Mesh& mesh : kit.meshes)
        for (int i = 0; i < 100; ++i) {
            const Vec3 point = detail::to_float(random.in_cube<3>() * 3.0);
            ASSERT_EQ(contains(solid(mesh), point), contains(mesh, point));
            ASSERT_EQ(contains(solid(mesh), point), overlaps(solid(mesh), Sphere{point, 0}));
        }
}

template <class A, class B>
concept Intersects = requires(const A& a, const B& b) {
    intersection(a, b);
};
static_assert(!Intersects<Solid<Mesh>, Box3> && !Intersects<Box3, Solid<const Mesh&>>, "a solid is no polytope");

/// Sweeps a shape against a box and against the same box as a solid, in both orders.
template <class Shape>
void expect_same_sweep(const Shape& shape, const Vec3& motion, const Mesh& mesh, const Pose3& pose) {
    const Box3 box{pose.position, half, pose.rotation};
    const Closest<3> start = closest(shape, box), other = closest(shape, at(solid(mesh), pose));
    if (start.distance < 0 && glm::dot(start.normal, other.normal) < 0.999f) return;
    // A motion along the surface may be either.
    if (start.distance < 0 && std::abs(glm::dot(start.normal, glm::normalize(motion))) < 0.05f) return;
    const std::optional<Hit<3>> expected = sweep(shape, motion, box);
    expect_same_hit(sweep(shape, motion, at(solid(mesh), pose)), expected);
    const std::optional<Hit<3>> swapped = sweep(at(solid(mesh), pose), -motion, shape);
    ASSERT_EQ(swapped.has_value(), expected.has_value());
    if (expected) {
        EXPECT_NEAR(swapped->fraction, expected->fraction, 2e-5);
    }
    Motion3 turning{{{0, 0, 0}}, motion};
    const std::optional<Hit<3>> slow = sweep(shape, turning, at(solid(mesh), pose), Motion3{});
    ASSERT_EQ(slow.has_value(), expected.has_value());
    if (expected) {
        EXPECT_NEAR(slow->fraction, expected->fraction, 1e-4);
    }
}

TEST(SolidMotion, SweepsOfABoxAreThoseOfTheBox) {
    constexpr std::uint64_t seed = 20293;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Mesh mesh = box_surface(-half, half).mesh();
    int inside = 0;
    for (int i = 0; i < 400; ++i) {
        SCOPED_TRACE(i);
        const Pose3 pose{detail::to_float(random.in_cube<3>()), random.rotation<3>()};
        const auto place = [&] { return detail::to_float(random.in_cube<3>() * 3.0); };
        const Vec3 from = place(), motion = place() - from;
        const Sphere ball{from, 0.25f};
        const Capsule3 capsule{from, from + place() * 0.1f, 0.2f};
        const Box3 box{from, {0.2f, 0.3f, 0.25f}, random.rotation<3>()};
        if (closest(ball, Box3{pose.position, half, pose.rotation}).distance < 0) ++inside;
        expect_same_sweep(ball, motion, mesh, pose);
        expect_same_sweep(capsule, motion, mesh, pose);
        expect_same_sweep(box, motion, mesh, pose);
    }
    EXPECT_GT(inside, 10);
}

TEST(SolidMotion, SweepsLeaveAndEnterAgain) {
    const Mesh u = mesh_of(scenes::kit()[2]);
    // A ball wholly inside one arm, near the gap.
    const Sphere ball{{0.75f, 1.5f, 0.5f}, 0.125f};
    const std::optional<Hit<3>> hit = sweep(ball, Vec3(2, 0, 0), solid(u));
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 1.125f, 1e-4);
    EXPECT_NEAR(hit->fraction, 0.5625f, 1e-4);
    EXPECT_FALSE(hit->started_inside);
    EXPECT_FALSE(sweep(ball, Vec3(0.5f, 0, 0), solid(u)));
    const std::optional<Hit<3>> in = sweep(ball, Vec3(-1, 0, 0), solid(u));
    ASSERT_TRUE(in);
    EXPECT_EQ(in->fraction, 0);
    EXPECT_TRUE(in->started_inside);
    const Mesh box = box_surface({0.625f, 1.25f, 0.375f}, {0.875f, 1.5f, 0.625f}).mesh();
    const std::optional<Hit<3>> mesh_hit = sweep(solid(box), Vec3(2, 0, 0), solid(u));
    ASSERT_TRUE(mesh_hit);
    EXPECT_NEAR(mesh_hit->distance, 1.125f, 1e-4);
}

}  // namespace
}  // namespace abut::test
