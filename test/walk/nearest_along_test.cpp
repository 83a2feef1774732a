// The first point of a walk mesh along a ray: against a reference over all triangles; and rays to edges and corners,
// along a triangle, and from a point of one.

#include "../oracle/simd_targets.hpp"
#include "../query/hash.hpp"
#include "long_vectors.hpp"
#include "walk_surfaces.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using oracle::Random;
Long position_of(const WalkMesh& mesh, const WalkPoint& place) {
    const glm::uvec3& t = mesh.triangles()[place.triangle];
    const auto at = [&](std::uint32_t k) { return Long(mesh.points()[k]); };
    const Long w(place.weights);
    return at(t.x) * w.x + at(t.y) * w.y + at(t.z) * w.z;
}

/// The first intersection of a line with the planes of triangles, of those that it crosses at least this far inside.
long double first_along(const WalkMesh& mesh, const Vec3& point, const Long& direction, long double inside) {
    long double result = std::numeric_limits<long double>::infinity();
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        if (!mesh.is_walkable(i)) continue;
        const glm::uvec3& t = mesh.triangles()[i];
        const auto at = [&](std::uint32_t k) { return Long(mesh.points()[k]) - Long(point); };
        const Long a = at(t.x), b = at(t.y), c = at(t.z), normal = turned(b - a, c - a);
        const long double volume = product(normal, direction);
        const long double weights[3] = {product(turned(b, c), direction) / volume,
                                        product(turned(c, a), direction) / volume,
                                        product(turned(a, b), direction) / volume};
        const long double along = product(normal, a) / volume;
        if (*std::min_element(weights, weights + 3) >= inside && along >= inside) result = std::min(result, along);
    }
    return result;
}

class WalkNearestAlong : public oracle::BySimdTarget {};

TEST_P(WalkNearestAlong, is_the_first_of_all_triangles) {
    const std::uint64_t seed = 1;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    int met = 0, missed = 0;
    std::vector<NamedSurface> all = surfaces(seed);
    // And a surface with coordinates whose products aren't exact in float.
    all.push_back({"huge hills", hills(24)});
    for (Vec3& point : all.back().surface.points) point *= 1e13f;
    for (const auto& [name, surface] : all) {
        SCOPED_TRACE(name);
        const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
        ASSERT_TRUE(mesh);
        const double size = size_of(surface);
        const auto count = static_cast<std::uint32_t>(surface.points.size());
        for (int i = 0; i < 30; ++i) {
            const Vec3 about = surface.points[random.below(count)];
            const Vec3 point = about + to_float(random.in_cube<3>() * (0.5 * size));
            const Vec3 target = surface.points[random.below(count)] + to_float(random.in_cube<3>() * (0.1 * size));
            const Vec3 toward = target - point;
            const Long direction(toward);
            // Some intersection is certainly inside; others are possible up to rounding.
            const long double sure = first_along(*mesh, point, direction, 1e-9L),
                              maybe = first_along(*mesh, point, direction, -1e-9L);
            const std::optional<WalkPoint> place = mesh->nearest_along(point, toward);
            if (maybe == std::numeric_limits<long double>::infinity()) {
                ++missed;
                EXPECT_FALSE(place);
                continue;
            }
            if (sure != maybe) continue;
            ++met;
            ASSERT_TRUE(place);
            const Long off = position_of(*mesh, *place) - (Long(point) + direction * sure);
            EXPECT_LT(std::sqrt(product(off, off)), 1e-6L * size);

            // The hit doesn't depend on the direction's length, and isn't beyond the surface.
            EXPECT_EQ(mesh->nearest_along(point, toward * 0x1p-30f), place);
            EXPECT_EQ(mesh->nearest_along(point, toward * 0x1p40f), place);
            const double distance = static_cast<double>(sure * std::sqrt(product(direction, direction)));
            EXPECT_EQ(mesh->nearest_along(point, direction, static_cast<float>(distance * 1.000001)), place);
            const auto sooner = mesh->nearest_along(point, direction, static_cast<float>(distance * 0.999999));
            EXPECT_FALSE(sooner);
        }
    }
    EXPECT_GT(met, 150);
    EXPECT_GT(missed, 50);
}

/// From within a closed surface each ray hits it, also at corners and edges, and nearly parallel to a face.
TEST_P(WalkNearestAlong, goes_through_no_edge) {
    const std::uint64_t seed = 2;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    for (const double height : {1.0, 0.1, 1e-3, 1e-4, 1e-5}) {
        scenes::BumpyBall ball = scenes::bumpy_ball(24, 0.1, 0.02, random);
        for (Vec3& point : ball.points) point.z *= static_cast<float>(height);
        const Result<WalkMesh> mesh = WalkMesh::build(ball.points, ball.triangles);
        ASSERT_TRUE(mesh);
        for (int i = 0; i < 4000; ++i) {
            const glm::uvec3& t = ball.triangles[random.below(static_cast<std::uint32_t>(ball.triangles.size()))];
            const double along = random.chance(0.5) ? random.unit() : 0;
            const DVec<3> a(ball.points[t.x]), b(ball.points[t.y]);
            const Vec3 point = to_float(random.in_cube<3>() * DVec<3>(0.2, 0.2, 0.2 * height));
            const Vec3 target = to_float(a + (b - a) * along);
            EXPECT_TRUE(mesh->nearest_along(point, target - point));
        }
    }
}

/// Without rounding: exactly through corners and edges, those of the border too, and beside them.
TEST_P(WalkNearestAlong, edges_and_corners_belong_to_it) {
    const Surface surface = flat(4, 4);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    for (std::uint32_t column = 0; column <= 16; ++column)
        for (std::uint32_t row = 0; row <= 16; ++row)
            for (const Vec3& direction : {Vec3(0, 0, -1), Vec3(1, 0, -1), Vec3(0.25f, -0.5f, -2), Vec3(16, 8, -1)}) {
                const Vec3 target = to_float(DVec<3>(0.25 * column, 0.25 * row, 0));
                for (const float side : {1.0f, -1.0f}) {
                    const Vec3 down(direction.x, direction.y, side * direction.z);
                    const std::optional<WalkPoint> place = mesh->nearest_along(target - 2.0f * down, down);
                    ASSERT_TRUE(place);
                    EXPECT_EQ(mesh->to_world(*place), target);
                    // There is nothing in the opposite direction.
                    EXPECT_FALSE(mesh->nearest_along(target - 2.0f * down, -down));
                }
            }
    for (const float beside : {-1e-6f, 4.000001f}) {
        EXPECT_FALSE(mesh->nearest_along({beside, 2, 1}, {0, 0, -1}));
        EXPECT_FALSE(mesh->nearest_along({2, beside, 1}, {0, 0, -1}));
    }
    EXPECT_TRUE(mesh->nearest_along({1, 2, 3}, {0, 0, -5}, 3));
    EXPECT_FALSE(mesh->nearest_along({1, 2, 3}, {0, 0, -5}, std::nextafter(3.0f, 0.0f)));
    EXPECT_FALSE(mesh->nearest_along({1, 2, 3}, {0, 0, -5}, -1));
    EXPECT_FALSE(mesh->nearest_along({1, 2, 3}, {0, 0, -5}, std::numeric_limits<float>::quiet_NaN()));
}

TEST_P(WalkNearestAlong, along_its_plane_it_begins_at_the_border) {
    const Surface surface = flat(4, 4);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    const auto at = [&](const Vec3& point, const Vec3& direction) {
        const std::optional<WalkPoint> place = mesh->nearest_along(point, direction);
        return place ? mesh->to_world(*place) : Vec3(-1.0f);
    };
    EXPECT_EQ(at({-3, 1.5f, 0}, {1, 0, 0}), Vec3(0, 1.5f, 0));
    EXPECT_EQ(at({-3, 2, 0}, {1, 0, 0}), Vec3(0, 2, 0));
    EXPECT_EQ(at({-1, -1, 0}, {2, 2, 0}), Vec3(0, 0, 0));
    EXPECT_EQ(at({-1, 5, 0}, {1, 0, 0}), Vec3(-1.0f));
    EXPECT_EQ(at({-1, 4, 0}, {1, 0, 0}), Vec3(0, 4, 0));
    EXPECT_EQ(at({-1, 1, 0.001f}, {1, 0, 0}), Vec3(-1.0f));
    EXPECT_TRUE(mesh->nearest_along({-3, 1.5f, 0}, {1, 0, 0}, 3));
    EXPECT_FALSE(mesh->nearest_along({-3, 1.5f, 0}, {1, 0, 0}, 2.9f));
    const std::vector<Vec3> corners{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}};
    const Result<WalkMesh> one = WalkMesh::build(corners, std::vector<glm::uvec3>{{0, 1, 2}});
    ASSERT_TRUE(one);
    EXPECT_TRUE(one->nearest_along({-3, 2, 0}, {1, 0, 0}, 5));
    EXPECT_FALSE(one->nearest_along({-3, 2, 0}, {1, 0, 0}, 4));
    // Nearly horizontal: it hits at the point of entry.
    const Vec3 skimmed = at({-1, 1.5f, 0x1p-22f}, {1, 0, -0x1p-24f});
    EXPECT_NEAR(skimmed.x, 3, 1e-5);
    EXPECT_EQ(skimmed.z, 0);
}

TEST_P(WalkNearestAlong, what_starts_on_it_is_there) {
    const Surface surface = flat(4, 4);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const float x = random.uniform_float(0, 4), y = random.uniform_float(0, 4);
        const Vec3 point(x, y, 0.0f), direction = to_float(random.direction<3>());
        const std::optional<WalkPoint> place = mesh->nearest_along(point, direction, 0);
        ASSERT_TRUE(place);
        EXPECT_LT(glm::length(mesh->to_world(*place) - point), 1e-6f);
        EXPECT_EQ(mesh->nearest_along(point, direction), place);
    }
}

/// Walls, seen from above along them: the ray hits their upper edges.
TEST_P(WalkNearestAlong, upright_walls_are_met_at_their_edges) {
    Surface wall;
    wall.points = {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    const Result<WalkMesh> mesh = WalkMesh::build(wall.points, wall.triangles);
    ASSERT_TRUE(mesh);
    for (const float x : {0.0f, 0.3f, 2.0f, 3.7f, 4.0f}) {
        const std::optional<WalkPoint> place = mesh->nearest_along({x, 0, 10}, {0, 0, -1});
        ASSERT_TRUE(place);
        EXPECT_LT(glm::length(mesh->to_world(*place) - Vec3(x, 0, 3)), 1e-6f);
    }
}

TEST_P(WalkNearestAlong, of_any_size) {
    const std::uint64_t seed = 4;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    for (const double scale : {1e-15, 1e-6, 1e5, 1e11, 1e13}) {
        SCOPED_TRACE(scale);
        Surface surface = hills(12);
        for (Vec3& point : surface.points) point *= static_cast<float>(scale);
        const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
        ASSERT_TRUE(mesh);
        for (int i = 0; i < 50; ++i) {
            const double x = random.uniform(0.1, 11.9), y = random.uniform(0.1, 11.9);
            const Vec3 above = to_float(DVec<3>(x, y, 30) * scale);
            const std::optional<WalkPoint> place = mesh->nearest_along(above, {0, 0, -2});
            ASSERT_TRUE(place);
            const Vec3 there = mesh->to_world(*place);
            EXPECT_NEAR(there.x, above.x, 3e-6 * scale);
            EXPECT_NEAR(there.y, above.y, 3e-6 * scale);
            EXPECT_FALSE(mesh->nearest_along(above, {0, 0, 2}));
        }
    }
}

TEST_P(WalkNearestAlong, is_the_same_bits_everywhere) {
    Hash hash;
    Random random(5);
    const Surface surface = stepped_hills(24, random);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    const auto number = [&](std::uint32_t most) { return static_cast<float>(random.below(most)) / 128; };
    for (int i = 0; i < 2000; ++i) {
        Vec3 point, target;
        for (int k = 0; k < 3; ++k) point[k] = number(4096) - 4;
        for (int k = 0; k < 3; ++k) target[k] = number(3072);
        if (point == target) continue;
        const std::optional<WalkPoint> place = mesh->nearest_along(point, target - point);
        hash.add(std::uint64_t{place ? place->triangle : no_walk_side});
        if (place) hash.add<3>(place->weights);
    }
    EXPECT_EQ(hash.value(), 0x0ccc851706aaa6c9u);
}

INSTANTIATE_TEST_SUITE_P(Each, WalkNearestAlong, oracle::simd_targets(), oracle::simd_target_name);

TEST(WalkNearestAlongInput, a_ray_of_length_zero_or_not_finite_hits_nothing) {
    const Surface surface = flat(3, 3);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    EXPECT_FALSE(mesh->nearest_along({1, 1, 1}, {0, 0, 0}));
    for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        EXPECT_FALSE(mesh->nearest_along({1, 1, wrong}, {0, 0, -1}));
        EXPECT_FALSE(mesh->nearest_along({1, 1, 1}, {0, 0, -wrong}));
    }
}

}  // namespace
}  // namespace abut::test
