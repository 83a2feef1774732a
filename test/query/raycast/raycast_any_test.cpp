// raycast_any against raycast, with every SIMD target: of a mesh for rays that end, start or pass within rounding of
// its triangles, and of all kinds of shapes.

#include "../../../scenes/bumpy_ball.hpp"
#include "../../oracle/random.hpp"
#include "../../oracle/simd_targets.hpp"
#include "../../shape/meshes.hpp"
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/solid_mesh.hpp>
#include <abut/world/world.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

struct AnyHitCounts {
    int rays = 0, hits = 0;
};

template <int D, class S>
void compare_any_hit(const Ray<D>& ray, const S& shape, const QueryOptions<D>& options, AnyHitCounts& counts) {
    const bool hits = raycast(ray, shape, options).has_value();
    ++counts.rays;
    counts.hits += hits ? 1 : 0;
    EXPECT_EQ(raycast_any(ray, shape, options), hits) << "ray " << counts.rays;
}

/// Compares for the ray, and for rays that end or start within a few roundings of its first hit. Some have a direction
/// of another length.
template <class S>
void compare_around_hit(oracle::Random& random, Ray3 ray, const S& shape, AnyHitCounts& counts) {
    const QueryOptions<3> options{.back_faces = random.below(2) == 0};
    if (random.below(8) == 0) ray.direction *= static_cast<float>(random.power_of_two(-8, 8));
    if (random.below(8) == 0) ray.direction *= random.uniform_float(0.99999f, 1.00001f);
    compare_any_hit(ray, shape, options, counts);
    const auto hit = raycast(ray, shape, options);
    if (!hit) return;
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float length :
         {hit->distance, std::nextafter(hit->distance, 0.0f), std::nextafter(hit->distance, infinity),
          hit->distance * (1 - 4e-6f), hit->distance * (1 + 4e-6f)})
        compare_any_hit(Ray3{ray.origin, ray.direction, length}, shape, options, counts);
    for (const float back : {0.0f, 1e-7f, 1e-5f, 1e-3f, 1e-2f}) {
        const Vec3 start = to_float(DVec<3>(hit->point) - DVec<3>(ray.direction) * static_cast<double>(back));
        compare_any_hit(Ray3{start, ray.direction, ray.length}, shape, options, counts);
    }
}

Surface surface_of_kind(oracle::Random& random, int kind) {
    if (kind == 0) return random_soup(random, 150, 1, 0.7);
    if (kind == 1) return box_surface({-1, -1, -1}, {1, 1, 1});
    const scenes::BumpyBall ball = scenes::bumpy_ball(12, 0, 0.3, random);
    return {ball.points, ball.triangles};
}

/// A ray at a vertex, at a point of an edge, along a face within rounding, or at any point.
Ray3 ray_at_surface(oracle::Random& random, const Surface& surface) {
    const glm::uvec3& t = surface.triangles[random.below(static_cast<std::uint32_t>(surface.triangles.size()))];
    const DVec<3> a(surface.points[t.x]), b(surface.points[t.y]), c(surface.points[t.z]);
    const DVec<3> away = random.direction<3>();
    const double far = random.power_of_two(-6, 10);
    switch (random.below(5)) {
        case 0:
            return Ray3::between(to_float(a + away * far), to_float(a));
        case 1:
            return Ray3::between(to_float(a + away * far), to_float((a + b) * 0.5));
        case 2: {
            const DVec<3> inside = a * 0.5 + b * 0.3 + c * 0.2;
            const double rise = random.below(2) == 0 ? 0.0 : random.power_of_two(-24, -6);
            return Ray3::between(to_float(inside + (b - c) * 3.0 + away * rise), to_float(inside));
        }
        case 3:
            return Ray3::between(to_float(away * far), to_float(random.in_cube<3>()));
        default: {
            Ray3 ray = Ray3::between(to_float(a + away * far), to_float(a * 0.4 + b * 0.3 + c * 0.3));
            ray.length = std::numeric_limits<float>::infinity();
            return ray;
        }
    }
}

class RaycastAny : public oracle::BySimdTarget {};

TEST_P(RaycastAny, HitsAMeshIfRaycastDoes) {
    oracle::Random random(71);
    AnyHitCounts counts;
    for (int i = 0; i < 24; ++i) {
        SCOPED_TRACE(i);
        Surface surface = surface_of_kind(random, i % 3);
        const float size = static_cast<float>(random.power_of_two(-10, 12));
        const Vec3 middle = to_float(random.in_cube<3>() * random.power_of_two(-4, 6));
        const Mesh unscaled = surface.mesh();
        const Pose3 pose{middle, random.rotation<3>()};
        Surface scaled = surface;
        for (Vec3& point : scaled.points) point = (middle + point) * size;
        const Mesh mesh = scaled.mesh();
        const Vec3 uneven{1.5f, -0.02f, 1}, even{-2, 2, 2};
        for (int k = 0; k < 100; ++k) {
            const Ray3 ray = ray_at_surface(random, surface);
            compare_around_hit(random, ray_at_surface(random, scaled), mesh, counts);
            compare_around_hit(random, ray, at(unscaled, pose), counts);
            compare_around_hit(random, ray, stretched(unscaled, uneven), counts);
            compare_around_hit(random, ray, at(stretched(unscaled, even), pose), counts);
        }
    }
    EXPECT_GT(counts.hits, counts.rays / 4);
    EXPECT_LT(counts.hits, counts.rays / 4 * 3);
}

TEST_P(RaycastAny, HitsAnyShapeIfRaycastDoes) {
    oracle::Random random(72);
    const Mesh mesh = surface_of_kind(random, 2).mesh();
    const auto polygon = Polygon::build(std::vector<Vec2>{{-1, -1}, {1, -1}, {0, 1}});
    const auto chain = Chain::build(std::vector<Vec2>{{-1, -1}, {1, -0.5f}, {0, 1}}, false);
    const Sphere ball{{0.2f, 0, 0}, 0.8f};
    const Box3 box{{0, 0.3f, 0}, {0.5f, 0.4f, 0.6f}};
    const auto compound = Compound3::build({at(ball, Pose3{{1, 0, 0}}), box});
    World<3> world;
    world.add(mesh, {.pose = {{0.5f, 0, 0}}});
    world.add(box, {.pose = {{-1, 0, 0}}});
    AnyHitCounts counts, in_plane;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 from = to_float(random.in_cube<3>() * 3.0);
        Ray3 ray = Ray3::between(from, to_float(random.in_cube<3>() * 1.5));
        if (i % 7 == 0) ray.direction = Vec3(0);
        compare_any_hit(ray, mesh, {}, counts);
        compare_any_hit(ray, ball, {}, counts);
        compare_any_hit(ray, at(box, Pose3{{0, 1, 0}}), {}, counts);
        compare_any_hit(ray, rounded(box, 0.1f), {}, counts);
        compare_any_hit(ray, rounded(mesh, 0.1f), {}, counts);
        compare_any_hit(ray, solid(mesh), {}, counts);
        compare_any_hit(ray, *compound, {}, counts);
        compare_any_hit(ray, HalfSpace3{{0, 1, 0}, 0.2f}, {}, counts);
        EXPECT_EQ(world.raycast_any(ray), world.raycast(ray).has_value());
        Ray2 flat = Ray2::between(Vec2(from), Vec2(to_float(random.in_cube<2>())));
        compare_any_hit(flat, *polygon, {}, in_plane);
        compare_any_hit(flat, *chain, {}, in_plane);
        compare_any_hit(flat, at(*chain, Pose2{{0.3f, 0}}), {}, in_plane);
    }
    for (const AnyHitCounts& some : {counts, in_plane}) {
        EXPECT_GT(some.hits, some.rays / 4);
        EXPECT_LT(some.hits, some.rays / 4 * 3);
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, RaycastAny, oracle::simd_targets(), oracle::simd_target_name);

TEST(RaycastAnySolidBsp, StopsAtTheFirstHitOfALevelAsWell) {
    const Surface box = box_surface({-1, -1, -1}, {1, 1, 1});
    const SolidBsp3 level = *SolidBsp3::build(box.points, box.triangles);
    EXPECT_TRUE(raycast_any(Ray3{{-3, 0, 0}, {1, 0, 0}, 5}, level));
    EXPECT_FALSE(raycast_any(Ray3{{-3, 0, 0}, {1, 0, 0}, 1}, level));
}

}  // namespace

}  // namespace abut::test
