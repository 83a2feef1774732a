// Rays that start next to shapes without interior. If the start is farther than 16 ulp of the coordinates, a ray
// towards the shape hits it, and a ray away from it does not.

#include "../../oracle/random.hpp"
#include <abut/query/detail/raycast/part_hit.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <array>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

template <int D>
using Corners = std::array<Vec<D>, static_cast<std::size_t>(D)>;

DVec<2> normal_of(const Corners<2>& c) {
    const DVec<2> along = DVec<2>(c[1]) - DVec<2>(c[0]);
    return normalized(DVec<2>(along.y, -along.x));
}
DVec<3> normal_of(const Corners<3>& c) {
    return normalized(cross(DVec<3>(c[1]) - DVec<3>(c[0]), DVec<3>(c[2]) - DVec<3>(c[0])));
}

/// Passes rays next to a part to `check`: the ray, its descent for each length, and its height.
template <int D, class Check>
void each_start(std::uint64_t seed, Check&& check) {
    int close = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        SCOPED_TRACE(testing::Message() << "seed " << seed + i);
        oracle::Random random(seed + i);
        const double size = random.power_of_two(-10, 14);
        Corners<D> corners;
        for (Vec<D>& corner : corners) corner = to_float(random.in_cube<D>() * size);
        const DVec<D> up = normal_of(corners) * (random.chance(0.5) ? 1.0 : -1.0);
        DVec<D> middle(0.0);
        for (const Vec<D>& corner : corners) middle += DVec<D>(corner) * (1.0 / D);
        // The corner is wide enough for the ray to end in it.
        double widest = 0, narrowest = std::numeric_limits<double>::infinity();
        for (const Vec<D>& corner : corners) {
            widest = std::max(widest, length(DVec<D>(corner) - middle));
            narrowest = std::min(narrowest, length(DVec<D>(corner) - middle));
        }
        if (narrowest < 0.3 * widest) continue;

        const Vec<D> origin = to_float(middle + up * (size * random.power_of_two(-21, -7)));
        const Vec<D> direction = to_float(normalized(random.direction<D>() * 0.5 - up));
        const double height = dot(up, DVec<D>(origin) - DVec<D>(corners[0]));
        const double sinks = -dot(up, normalized(DVec<D>(direction)));
        double seen = 0;
        for (const Vec<D>& corner : corners) seen = std::max(seen, largest(DVec<D>(corner) - DVec<D>(origin)));
        // The largest ulp of numbers of that size.
        if (!(height > 16 * 0x1p-23 * seen)) continue;
        close += height < 1e-5 * widest ? 1 : 0;
        check(corners, Ray<D>{origin, direction}, height / sinks, up);
    }
    EXPECT_GT(close, 100);
}

template <int D, class S>
void hits_it_from(const S& shape, const Ray<D>& ray, double along, const DVec<D>& up) {
    const std::optional<Hit<D>> hit = raycast(ray, shape);
    ASSERT_TRUE(hit) << along;
    EXPECT_NEAR(hit->distance, along, 1e-3 * along);
    EXPECT_GT(dot(DVec<D>(hit->normal), up), 0.999);
    EXPECT_FALSE(hit->started_inside);
    EXPECT_FALSE(raycast({ray.origin, ray.direction * -1.0f}, shape)) << "away from it";
}

TEST(RaycastStart, AboveASegment) {
    each_start<2>(1, [](const Corners<2>& c, const Ray2& ray, double along, const DVec<2>& up) {
        hits_it_from(Segment2{c[0], c[1]}, ray, along, up);
    });
}

TEST(RaycastStart, AboveATriangle) {
    each_start<3>(10'000, [](const Corners<3>& c, const Ray3& ray, double along, const DVec<3>& up) {
        hits_it_from(Triangle3{c[0], c[1], c[2]}, ray, along, up);
        // The iterative raycast, which is used at sharp corners, must agree.
        const DRay<3> beam{DVec<3>(ray.origin), normalized(DVec<3>(ray.direction)), 1e9};
        PartHit<3> hit;
        const Triangle3 triangle{c[0], c[1], c[2]};
        ASSERT_TRUE(part_hit_by_advance<3>(beam, convex(triangle), 0, nullptr, hit));
        EXPECT_NEAR(hit.along, along, 1e-3 * along);
    });
}

TEST(RaycastStart, AboveAMesh) {
    each_start<3>(20'000, [](const Corners<3>& c, const Ray3& ray, double along, const DVec<3>& up) {
        const Mesh mesh = *Mesh::build(std::vector<Vec3>(c.begin(), c.end()), std::vector<glm::uvec3>{{0, 1, 2}});
        hits_it_from(mesh, ray, along, up);
        hits_it_from(stretched(mesh, Vec3(1)), ray, along, up);
    });
}

TEST(RaycastStart, FiveCentimetresAboveTenKilometres) {
    const Mesh ground =
        *Mesh::build(std::vector<Vec3>{{0, 0, 0}, {0, 0, 10000}, {10000, 0, 0}}, std::vector<glm::uvec3>{{0, 1, 2}});
    const auto hit = raycast(Ray3{{3000, 0.05f, 3000}, {0, -1, 0}}, ground);
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->distance, 0.05f);
    EXPECT_FALSE(raycast(Ray3{{3000, 0, 3000}, {0, -1, 0}}, ground)) << "on it";
}

}  // namespace
}  // namespace abut
