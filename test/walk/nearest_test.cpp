// The nearest point of a walk mesh: against a reference over all triangles; and bit for bit against the search's own
// distances of all triangles, for each SIMD target.

#include "../broad_phase/allocations.hpp"
#include "../oracle/is_long.hpp"
#include "../oracle/simd_targets.hpp"
#include "../query/hash.hpp"
#include "long_vectors.hpp"
#include "walk_surfaces.hpp"
#include <abut/walk/data.hpp>
#include <abut/walk/nearest_on.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <algorithm>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using oracle::Random;
/// The squared distance of a point from a triangle: from the nearest of its sides, or from its plane above the inside.
long double square_from(const Long& p, const Long& a, const Long& b, const Long& c) {
    const auto from_side = [&](const Long& start, const Long& end) {
        const Long along = end - start;
        const long double part = std::clamp(product(p - start, along) / product(along, along), 0.0L, 1.0L);
        const Long direction = start + along * part - p;
        return product(direction, direction);
    };
    const long double beside = std::min({from_side(a, b), from_side(b, c), from_side(c, a)});
    const Long normal = turned(b - a, c - a);
    const auto is_inside = [&](const Long& start, const Long& end) {
        return product(turned(end - start, p - start), normal) >= 0;
    };
    if (!is_inside(a, b) || !is_inside(b, c) || !is_inside(c, a)) return beside;
    const long double height = product(p - a, normal);
    return std::min(beside, height * height / product(normal, normal));
}

Triangle3 triangle_of(const WalkMesh& mesh, std::uint32_t triangle) {
    const glm::uvec3& t = mesh.triangles()[triangle];
    return {mesh.points()[t.x], mesh.points()[t.y], mesh.points()[t.z]};
}
Long position(const WalkMesh& mesh, const WalkPoint& place) {
    const Triangle3 t = triangle_of(mesh, place.triangle);
    const Long w(place.weights);
    return Long(t.a) * w.x + Long(t.b) * w.y + Long(t.c) * w.z;
}
/// The least squared distance of all triangles and the first triangle with it, measured as the search does.
struct Least {
    double square = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
};
Least min_of_all(const WalkMesh& mesh, const Vec3& point) {
    Least result;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        if (!mesh.is_walkable(i)) continue;
        const double square = nearest_on(triangle_of(mesh, i), DVec<3>(point)).square;
        if (square < result.square) result = {square, i};
    }
    return result;
}
long double reference_distance(const WalkMesh& mesh, const Vec3& point) {
    long double result = std::numeric_limits<long double>::infinity();
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        if (!mesh.is_walkable(i)) continue;
        const Triangle3 t = triangle_of(mesh, i);
        result = std::min(result, square_from(Long(point), Long(t.a), Long(t.b), Long(t.c)));
    }
    return std::sqrt(result);
}

void expect_valid(const WalkMesh& mesh, const WalkPoint& place) {
    ASSERT_LT(place.triangle, mesh.triangles().size());
    EXPECT_TRUE(mesh.is_walkable(place.triangle));
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        EXPECT_GE(place.weights[k], 0);
        const double grains = static_cast<double>(place.weights[k]) * 0x1p24;
        EXPECT_EQ(grains, std::floor(grains));
        sum += grains;
    }
    EXPECT_EQ(sum, 0x1p24);
}

/// Checks the nearest point of one query. For a needle triangle the distance may be too large by a share of its size.
void check(const WalkMesh& mesh, const Vec3& point, Random& random, double needle = 0) {
    const WalkPoint place = mesh.nearest(point);
    expect_valid(mesh, place);
    const Least least = min_of_all(mesh, point);
    EXPECT_EQ(place.triangle, least.triangle);

    const Triangle3 t = triangle_of(mesh, place.triangle);
    const double size = std::max(largest(DVec<3>(t.b) - DVec<3>(t.a)), largest(DVec<3>(t.c) - DVec<3>(t.a)));
    const long double truth = reference_distance(mesh, point);
    const double rounding = 1e-13 * (static_cast<double>(truth) + size);
    EXPECT_NEAR(0.5 * std::sqrt(least.square), static_cast<double>(truth), rounding + needle * size);
    const Long direction = position(mesh, place) - Long(point);
    EXPECT_NEAR(static_cast<double>(std::sqrt(product(direction, direction))), static_cast<double>(truth),
                rounding + (needle + 4 * 0x1p-24) * size);

    // The starting triangle doesn't change the answer.
    const std::uint32_t other = random.below(static_cast<std::uint32_t>(mesh.triangles().size()));
    EXPECT_EQ(mesh.nearest(point, WalkPoint{other, {1, 0, 0}}), place);
    EXPECT_EQ(mesh.nearest(point, place), place);

    // The reach is a float, and the comparison is in double.
    const float reach = static_cast<float>(0.5 * std::sqrt(least.square));
    for (const float requested : {std::nextafter(reach, 0.0f), reach, std::nextafter(reach, 3e38f), 3e38f}) {
        const double twice = 2 * static_cast<double>(requested);
        const std::optional<WalkPoint> found = mesh.nearest(point, requested);
        EXPECT_EQ(found.has_value(), least.square <= twice * twice) << requested;
        if (found) {
            EXPECT_EQ(*found, place);
        }
    }
}

Vec3 about(const Surface& surface, Random& random, double grown) {
    Aabb3 box = Aabb3::empty();
    for (const Vec3& point : surface.points) box = merged(box, Aabb3{point, point});
    const DVec<3> low(box.min), high(box.max);
    const double beyond = grown * length(high - low);
    DVec<3> result;
    for (int i = 0; i < 3; ++i) result[i] = random.uniform(low[i] - beyond, high[i] + beyond);
    return to_float(result);
}
/// A corner, a point on an edge or within a triangle, and points near it.
Vec3 near_by(const Surface& surface, Random& random) {
    const glm::uvec3& t = surface.triangles[random.below(static_cast<std::uint32_t>(surface.triangles.size()))];
    const DVec<3> a(surface.points[t.x]), b(surface.points[t.y]), c(surface.points[t.z]);
    const double u = random.unit() * random.below(2), v = (1 - u) * random.unit() * random.below(2);
    const double off = random.chance(0.3) ? 0 : random.power_of_two(-20, 1) * length(b - a);
    return to_float(a + (b - a) * u + (c - a) * v + random.direction<3>() * off);
}

Surface changed(Surface surface, double scale, const DVec<3>& offset) {
    for (Vec3& point : surface.points) point = to_float(DVec<3>(point) * scale + offset);
    return surface;
}

class WalkNearest : public oracle::BySimdTarget {};

void check_all(const std::vector<NamedSurface>& all, double scale, const DVec<3>& offset, Random& random, int count) {
    for (const auto& [name, given] : all) {
        SCOPED_TRACE(name);
        const Surface surface = changed(given, scale, offset);
        const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
        ASSERT_TRUE(mesh);
        for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
            check(*mesh, near_by(surface, random), random);
            check(*mesh, about(surface, random, 0.25), random);
        }
    }
}

TEST_P(WalkNearest, is_that_of_all_triangles_one_by_one) {
    const std::uint64_t seed = 1;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::vector<NamedSurface> all = surfaces(seed);
    const int count = oracle::is_long() ? 200 : 8;
    for (const double scale : {1e-3, 1.0, 1e4}) {
        SCOPED_TRACE(scale);
        check_all(all, scale, DVec<3>(0.0), random, count);
    }
    SCOPED_TRACE("far from the origin");
    check_all(all, 1, {3e3, -2e4, 5e4}, random, count);
}

TEST_P(WalkNearest, of_any_size_and_from_any_distance) {
    const std::uint64_t seed = 2;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::vector<NamedSurface> all = surfaces(seed);
    for (const double scale : {1e-18, 1e-10, 1e11, 1e13}) {
        SCOPED_TRACE(scale);
        check_all(all, scale, DVec<3>(0.0), random, 3);
    }
    for (const auto& [name, surface] : all) {
        SCOPED_TRACE(name);
        const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
        ASSERT_TRUE(mesh);
        const double size = size_of(surface);
        for (const double far : {10.0, 50.0, 70.0, 1e3, 1e6, 1e12, 1e30})
            for (int i = 0; i < 3; ++i) check(*mesh, to_float(random.direction<3>() * (far * size)), random);
    }
}

TEST_P(WalkNearest, in_a_large_mesh) {
    const std::uint64_t seed = 3;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Surface surface = hills(150);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    for (int i = 0; i < 3; ++i) {
        check(*mesh, near_by(surface, random), random);
        check(*mesh, about(surface, random, 0.25), random);
    }
}

TEST_P(WalkNearest, of_a_bridge_and_the_floor_below_it) {
    Surface surface = flat(12, 12);
    const Surface bridge = changed(flat(12, 2), 1, {0, 5, 4});
    surface = joined(surface, bridge);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    const std::uint32_t first_of_bridge = 2 * 12 * 12;
    Random random(4);
    for (int i = 0; i < 50; ++i) {
        const float x = random.uniform_float(1, 11), y = random.uniform_float(5.5, 6.5);
        const WalkPoint on_floor = mesh->nearest({x, y, 1.5f}), on_bridge = mesh->nearest({x, y, 2.5f});
        EXPECT_LT(on_floor.triangle, first_of_bridge);
        EXPECT_GE(on_bridge.triangle, first_of_bridge);
        // A point far from the last place is found as well.
        EXPECT_EQ(mesh->nearest({x, y, 1.5f}, on_bridge), on_floor);
        EXPECT_EQ(mesh->nearest({x, y, 2.5f}, on_floor), on_bridge);
        // In the middle both are equally far: the floor's indices are lower.
        EXPECT_LT(mesh->nearest({x, y, 2}, on_bridge).triangle, first_of_bridge);
        EXPECT_FALSE(mesh->nearest({x, y, 2}, 1.999f));
        EXPECT_TRUE(mesh->nearest({x, y, 2}, 2));
    }
}

/// Without rounding: each feature of the triangle is the closest one once.
TEST_P(WalkNearest, of_several_is_the_lowest) {
    const Surface surface = flat(10, 10);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    const auto lowest_at = [&](double x, double y) {
        for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
            const Triangle3 t = triangle_of(*mesh, i);
            const DVec<3> p(x, y, 0), a(t.a), b(t.b), c(t.c);
            if (cross(b - a, p - a).z >= 0 && cross(c - b, p - b).z >= 0 && cross(a - c, p - c).z >= 0) return i;
        }
        return 0u;
    };
    for (std::uint32_t column = 0; column <= 20; ++column)
        for (std::uint32_t row = 0; row <= 20; ++row)
            for (const float height : {0.0f, 0.25f, -3.0f, 100.0f}) {
                const double x = 0.5 * column, y = 0.5 * row;
                const Vec3 point = to_float(DVec<3>(x, y, height));
                const WalkPoint place = mesh->nearest(point);
                EXPECT_EQ(place.triangle, lowest_at(x, y)) << x << " " << y;
                EXPECT_EQ(mesh->to_world(place), Vec3(point.x, point.y, 0.0f));
                const bool at_border = column % 20 == 0 || row % 20 == 0;
                if (at_border || (column + row) % 2 == 0) {
                    EXPECT_EQ(std::min({place.weights.x, place.weights.y, place.weights.z}), 0);
                }
            }

    // The middle of a cube, and of two coinciding cubes with different indices.
    const Surface cube = box_surface({-1, -1, -1}, {1, 1, 1});
    EXPECT_EQ(WalkMesh::build(cube.points, cube.triangles)->nearest({0, 0, 0}).triangle, 0u);
}

/// Shared corners and edges are equally far from their triangles: the first triangle wins, also if all coordinates are
/// rounded.
TEST_P(WalkNearest, of_those_at_a_corner_is_the_lowest) {
    const std::uint64_t seed = 5;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    for (int i = 0; i < 200; ++i) {
        std::vector<double> heights;
        for (int k = 0; k < 7; ++k) heights.push_back(random.uniform(-2, -0.5));
        const Surface tip = changed(fan(heights), random.uniform(0.1, 10), random.in_cube<3>());
        const Result<WalkMesh> mesh = WalkMesh::build(tip.points, tip.triangles);
        ASSERT_TRUE(mesh);
        const float height = random.uniform_float(0, 5);
        const WalkPoint place = mesh->nearest(tip.points[0] + Vec3(0, 0, height));
        EXPECT_EQ(place, (WalkPoint{0, {1, 0, 0}}));
    }
}

/// The thinnest possible triangles, side by side at any slope.
TEST_P(WalkNearest, of_needles) {
    const std::uint64_t seed = 8;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    for (const double width : {1e-2, 1e-4, 1e-6, 1e-8}) {
        SCOPED_TRACE(width);
        const DVec<3> along = random.direction<3>(), across = random.direction<3>() * width;
        const auto at = [&](std::uint32_t column, std::uint32_t row) {
            return along * (column + 0.3 * row) + across * (0.5 * row);
        };
        const Surface surface = sheet(6, 6, at);
        const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
        ASSERT_TRUE(mesh);
        for (int i = 0; i < 50; ++i) {
            check(*mesh, near_by(surface, random), random, 1e-8);
            check(*mesh, about(surface, random, 0.25), random, 1e-8);
        }
    }
}

TEST_P(WalkNearest, leaves_out_what_is_left_out) {
    // Repeated triangles: without area where a neighbour can be cut, and where none can be.
    Surface surface = flat(6, 6);
    const auto count = static_cast<std::uint32_t>(surface.triangles.size());
    for (std::uint32_t i = 0; i < count; i += 3) surface.triangles.push_back(surface.triangles[i]);
    surface.points.emplace_back(0.5f, 0.0f, 0.0f);
    surface.triangles.emplace_back(0u, static_cast<std::uint32_t>(surface.points.size() - 1), 1u);
    for (const float x : {20.0f, 21.0f, 22.0f}) surface.points.emplace_back(x, 0.0f, 0.0f);
    const auto last = static_cast<std::uint32_t>(surface.points.size() - 1);
    surface.triangles.emplace_back(last - 2, last - 1, last);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    EXPECT_GT(mesh->report().duplicates, 0u);
    EXPECT_GT(mesh->report().left_out + mesh->report().flat, 0u);
    Random random(6);
    for (int i = 0; i < 200; ++i) check(*mesh, near_by(surface, random), random);
}

TEST_P(WalkNearest, is_the_same_bits_everywhere) {
    Hash hash;
    Random random(7);
    const Surface surface = stepped_hills(24, random);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    for (int i = 0; i < 2000; ++i) {
        Vec3 point;
        for (int k = 0; k < 3; ++k) point[k] = static_cast<float>(random.below(4096)) / 128 - 4;
        const WalkPoint place = mesh->nearest(point);
        hash.add(std::uint64_t{place.triangle});
        hash.add<3>(place.weights);
    }
    EXPECT_EQ(hash.value(), 0x0bb1b23e68f9478au);
}

/// This program's assertion handler returns.
TEST(WalkNearestInput, a_point_that_is_not_finite_gives_a_valid_place_or_none) {
    const Surface surface = flat(3, 3);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        for (int k = 0; k < 3; ++k) {
            Vec3 point(1.0f);
            point[k] = wrong;
            expect_valid(*mesh, mesh->nearest(point));
            EXPECT_EQ(mesh->nearest(point), mesh->nearest(point, WalkPoint{7, {1, 0, 0}}));
            EXPECT_FALSE(mesh->nearest(point, 1e30f));
        }
    EXPECT_EQ(mesh->nearest({1, 1, 1}, WalkPoint{1000, {1, 0, 0}}), mesh->nearest({1, 1, 1}));
}

TEST(WalkNearestInput, nothing_is_allocated) {
    const Surface surface = hills(20);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    const std::size_t before = allocations();
    int found = 0;
    for (const Vec3& point : surface.points) {
        const Vec3 above = point + Vec3(0.1f, 0.2f, 3.0f);
        const WalkPoint place = mesh->nearest(above);
        if (mesh->nearest(above, WalkPoint{0, {1, 0, 0}}) == place) ++found;
        if (mesh->nearest(above, 10.0f)) ++found;
        if (mesh->nearest_along(point, {0, 0, 1})) ++found;
    }
    EXPECT_EQ(allocations(), before);
    EXPECT_EQ(found, 3 * static_cast<int>(surface.points.size()));
}

TEST(WalkNearestInput, a_reach_below_zero_reaches_nothing) {
    const Surface surface = flat(3, 3);
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    const Vec3 on_it(1.25f, 1.5f, 0.0f);
    EXPECT_TRUE(mesh->nearest(on_it, 0.0f));
    EXPECT_TRUE(mesh->nearest(on_it, std::numeric_limits<float>::infinity()));
    EXPECT_FALSE(mesh->nearest(on_it, -1.0f));
    EXPECT_FALSE(mesh->nearest(on_it, std::numeric_limits<float>::quiet_NaN()));
}

INSTANTIATE_TEST_SUITE_P(Each, WalkNearest, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace
}  // namespace abut::test
