// Rays into solid trees, against every face of the level.

#include "../../scenes/wad.hpp"
#include "../oracle/is_long.hpp"
#include "solid_levels.hpp"
#include <abut/query/raycast.hpp>
#include <abut/shape/solid_bsp.hpp>

#include <filesystem>
#include <iostream>
#include <map>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

struct Rays {
    int cast = 0, hit = 0, unsure = 0;
};

template <int D>
void expect_same_ray(const Level<D>& level, const SolidBsp<D>& tree, const Ray<D>& ray, bool hollow, Rays& rays) {
    const DVec<D> direction = normalized(DVec<D>(ray.direction));
    const double expected = first_entry(level, ray.origin, direction, hollow);
    if (std::isnan(expected)) {
        ++rays.unsure;
        return;
    }
    ++rays.cast;
    const auto hit = raycast(ray, tree);
    const bool hits = std::isfinite(expected) && expected <= static_cast<double>(ray.length);
    if (hits && std::abs(expected - static_cast<double>(ray.length)) < 1e-5 * expected) return;
    ASSERT_EQ(hit.has_value(), hits) << "expected at " << expected;
    if (!hit) return;
    ++rays.hit;
    const double scale = 1 + expected;
    ASSERT_NEAR(static_cast<double>(hit->distance), expected, 1e-6 * scale);
    ASSERT_LT(dot(DVec<D>(hit->normal), direction), 0);
    ASSERT_NEAR(length(DVec<D>(hit->normal)), 1, 1e-6);
    ASSERT_EQ(hit->started_inside, place_in(level, ray.origin, hollow) == Place::inside);
    // The ray hits the reported face there.
    ASSERT_LT(hit->feature.part, level.faces.size());
    const Crossing crossings = crossing_of(level, hit->feature.part, DVec<D>(ray.origin), direction);
    ASSERT_EQ(crossings.turns, 1) << "face " << hit->feature.part;
    ASSERT_NEAR(crossings.along, expected, 1e-6 * scale);
}

template <int D>
Ray<D> ray_into(const Aabb<D>& box, oracle::Random& random) {
    Ray<D> ray;
    const DVec<D> low(box.min), extent = DVec<D>(box.max) - low;
    ray.origin = Vec<D>(low + extent * (DVec<D>(0.5) + 0.6 * random.in_cube<D>()));
    ray.direction = Vec<D>(random.direction<D>());
    if (random.chance(0.3)) ray.length = random.uniform_float(0, largest(extent));
    return ray;
}

TEST(SolidRaycast, OutlinesAndTheirHoles) {
    oracle::Random random(71);
    Rays rays;
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 71 level " << i);
        Level<2> level;
        for (int k = 0; k < 6; ++k)
            add_outline(level,
                        star(random, 3 + static_cast<int>(random.below(9)), Vec2(random.in_cube<2>() * 9.0), 1, 5));
        const bool hollow = i % 3 == 0;
        if (hollow) {
            Level<2> wall;
            add_outline(wall, star(random, 30, Vec2(0), 20, 25));
            turn_around(wall);
            const auto first = static_cast<std::uint32_t>(level.points.size());
            level.points.insert(level.points.end(), wall.points.begin(), wall.points.end());
            for (const auto& face : wall.faces) level.faces.push_back(face + first);
        }
        const SolidBsp2 tree = level.tree();
        for (int k = 0; k < 200; ++k) {
            expect_same_ray(level, tree, ray_into(tree.bounds(), random), hollow, rays);
            if (HasFatalFailure()) return;
        }
    }
    std::cout << rays.hit << " of " << rays.cast << " hit, " << rays.unsure << " unsure\n";
    EXPECT_GT(rays.hit, rays.cast * 3 / 10);
    EXPECT_LT(rays.hit, rays.cast * 8 / 10);
}

TEST(SolidRaycast, BoxesAndTerrain) {
    oracle::Random random(72);
    Rays rays;
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 72 level " << i);
        Surface surface = random_terrain(random, 5, 4).solid(-2);
        for (int k = 0; k < 4; ++k) {
            const Vec3 low(random.in_cube<3>() * 4.0);
            surface = joined(surface, box_surface(low, low + Vec3(DVec<3>(1.5) + random.in_cube<3>())));
        }
        const Level<3> level = level_of(surface);
        const SolidBsp3 tree = level.tree();
        for (int k = 0; k < 200; ++k) {
            expect_same_ray(level, tree, ray_into(tree.bounds(), random), false, rays);
            if (HasFatalFailure()) return;
        }
    }
    std::cout << rays.hit << " of " << rays.cast << " hit, " << rays.unsure << " unsure\n";
    EXPECT_GT(rays.hit, rays.cast * 15 / 100);
    EXPECT_LT(rays.hit, rays.cast * 8 / 10);
}

TEST(SolidRaycast, ByHand) {
    const SolidBsp3 cube = level_of(box_surface({0, 0, 0}, {2, 2, 2})).tree();
    const auto cast = [&](const Vec3& from, const Vec3& along, float length = 100) {
        return raycast(Ray3{from, along, length}, cube);
    };
    const auto hit = cast({-3, 1, 0.5f}, {1, 0, 0}, 6);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->distance, 3);
    EXPECT_EQ(hit->fraction, 0.5f);
    EXPECT_EQ(hit->point, Vec3(0, 1, 0.5f));
    EXPECT_EQ(hit->normal, Vec3(-1, 0, 0));
    EXPECT_FALSE(hit->started_inside);
    EXPECT_TRUE(cast({-3, 1, 0.5f}, {1, 0, 0}, 3)) << "ends on the face";
    EXPECT_FALSE(cast({-3, 1, 0.5f}, {1, 0, 0}, 2.99f));
    EXPECT_FALSE(cast({-3, 1, 0.5f}, {-1, 0, 0}));
    EXPECT_FALSE(cast({-3, 2, 0.5f}, {1, 0, 0})) << "slides along a face";
    EXPECT_FALSE(cast({2, 1, 1}, {1, 0, 0})) << "leaves a face";
    ASSERT_TRUE(cast({2, 1, 1}, {-1, 0, 0})) << "goes in where it starts";
    EXPECT_EQ(cast({2, 1, 1}, {-1, 0, 0})->distance, 0);
    EXPECT_FALSE(cast({1, 1, 1}, {1, 0, 0})) << "comes out of it";
    // Out of one and into the other.
    const SolidBsp3 two = level_of(joined(box_surface({0, 0, 0}, {2, 2, 2}), box_surface({5, 0, 0}, {6, 2, 2}))).tree();
    const auto next = raycast(Ray3{{1, 1, 0.5f}, {1, 0, 0}}, two);
    ASSERT_TRUE(next);
    EXPECT_EQ(next->distance, 4);
    EXPECT_TRUE(next->started_inside);
    // Two that touch are one interval.
    const SolidBsp3 row = level_of(joined(box_surface({0, 0, 0}, {2, 2, 2}), box_surface({2, 0, 0}, {4, 2, 2}))).tree();
    EXPECT_FALSE(raycast(Ray3{{1, 1, 0.5f}, {1, 0, 0}}, row));
    EXPECT_FALSE(raycast(Ray3{{2, 1, 0.5f}, {1, 0, 0}}, row)) << "starts between them";
    EXPECT_EQ(raycast(Ray3{{9, 1, 0.5f}, {-1, 0, 0}}, row)->distance, 5);
}

TEST(SolidRaycast, SlipsThroughNoCorner) {
    // Rays at corners and edges of a closed room, from inside: each must hit despite rounding.
    oracle::Random random(73);
    for (int i = 0; i < 20; ++i) {
        const Level<3> level = level_of(reversed(random_terrain(random, 6, 3).solid(-4)));
        const SolidBsp3 hollow = level.tree();
        for (int k = 0; k < 300; ++k) {
            const Vec3 eye(random.in_cube<3>() * 0.9 + DVec<3>(3, 3, -2));
            ASSERT_FALSE(hollow.contains(eye));
            const std::size_t face = random.below(static_cast<std::uint32_t>(level.faces.size()));
            const Vec3 a = level.corner(face, 0), b = level.corner(face, 1);
            Ray3 ray = Ray3::between(eye, k % 2 == 0 ? a : 0.5f * (a + b));
            ray.length = std::numeric_limits<float>::infinity();
            ASSERT_TRUE(raycast(ray, hollow)) << "seed 73 level " << i << " ray " << k;
        }
    }
}

/// Whether each corner is left as often as it is reached.
bool is_closed(const Level<2>& level) {
    std::map<std::pair<float, float>, int> balance;
    for (const glm::uvec2& face : level.faces) {
        ++balance[{level.points[face.x].x, level.points[face.x].y}];
        --balance[{level.points[face.y].x, level.points[face.y].y}];
    }
    return std::all_of(balance.begin(), balance.end(), [](const auto& each) { return each.second == 0; });
}

/// The counts over all maps.
struct Nodes {
    std::size_t maps = 0, walls = 0, all_lines = 0, wad = 0;
};

/// A map's walls; the void around it is solid.
void expect_same_map(const scenes::WadMap& map, oracle::Random& random, Nodes& nodes) {
    const Level<2> level{map.points, map.one_sided};
    const SolidBsp2 tree = level.tree();
    const bool closed = is_closed(level);
    Rays rays;
    int inside = 0, checked = 0;
    for (int i = 0; closed && i < 400; ++i) {
        const Ray2 ray = ray_into(tree.bounds(), random);
        const Place place = place_in(level, ray.origin, true);
        if (place == Place::on_nothing) continue;
        ASSERT_EQ(tree.contains(ray.origin), place == Place::inside) << ray.origin.x << " " << ray.origin.y;
        inside += place == Place::inside ? 1 : 0;
        ++checked;
        expect_same_ray(level, tree, ray, true, rays);
        if (testing::Test::HasFatalFailure()) return;
    }
    const std::size_t of_all_lines = Level<2>{map.points, map.lines}.tree().node_count();
    std::cout << map.name << (closed ? "" : " (open)") << ": " << map.one_sided.size() << " walls, depth "
              << tree.depth() << ", nodes " << tree.node_count() << "; of all " << map.lines.size() << " lines "
              << of_all_lines << ", its own " << map.nodes << "; " << inside << " of " << checked << " inside, "
              << rays.hit << " of " << rays.cast << " rays hit\n";
    ++nodes.maps;
    nodes.walls += tree.node_count();
    nodes.all_lines += of_all_lines;
    nodes.wad += map.nodes;
}

TEST(SolidRaycast, MapsOfFreedoom) {
    if (!oracle::is_long()) GTEST_SKIP() << "only where ABUT_LONG is set";
    Nodes nodes;
    oracle::Random random(74);
    for (const char* name : {"freedoom1.wad", "freedoom2.wad"}) {
        const std::filesystem::path path = std::filesystem::path("/usr/share/games/doom") / name;
        if (!std::filesystem::exists(path)) GTEST_SKIP() << "the Debian package freedoom isn't here";
        const auto wad = scenes::read_wad(path.string());
        ASSERT_TRUE(wad) << wad.problem().message;
        for (const scenes::WadMap& map : *wad) {
            SCOPED_TRACE(testing::Message() << name << " " << map.name << " seed 74");
            expect_same_map(map, random, nodes);
            if (HasFatalFailure()) return;
        }
    }
    std::cout << nodes.maps << " maps: " << nodes.walls << " nodes of walls, " << nodes.all_lines << " of all lines, "
              << nodes.wad << " their own\n";
    EXPECT_EQ(nodes.maps, 68u);
}

}  // namespace
}  // namespace abut::test
