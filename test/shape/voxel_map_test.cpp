#include "../oracle/random.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/voxel_map.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

using oracle::Random;

constexpr std::uint64_t seed = 20261130;

VoxelMap empty_map(const glm::uvec3& count, const Vec3& cell) {
    const std::size_t size = std::size_t{count.x} * count.y * count.z;
    return *VoxelMap::build(std::vector<std::uint64_t>((size + 63) / 64), count, cell);
}

/// Solid up to a height.
VoxelMap floor_of(const glm::uvec3& count, std::uint32_t height) {
    VoxelMap map = empty_map(count, Vec3(1.0f));
    for (std::uint32_t i = 0; i < count.x * count.y * height; ++i) map.set(i, true);
    return map;
}

VoxelMap random_map(Random& random) {
    const glm::uvec3 count(1 + random.below(9), 1 + random.below(9), 1 + random.below(9));
    const Vec3 cell(random.uniform_float(0.3, 1), random.uniform_float(0.3, 1), random.uniform_float(0.3, 1));
    VoxelMap map = empty_map(count, cell);
    const double filled = random.uniform(0.05, 0.95);
    for (std::uint32_t i = 0; i < map.size(); ++i)
        if (random.chance(filled)) map.set(i, true);
    return map;
}

std::vector<std::uint32_t> solid_voxels(const VoxelMap& map) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < map.size(); ++i)
        if (map.at(i)) result.push_back(i);
    return result;
}

Vec3 point_around(Random& random, const VoxelMap& map) {
    const Vec3 extent = Vec3(map.count()) * map.cell();
    return {random.uniform_float(-1, extent.x + 1), random.uniform_float(-1, extent.y + 1),
            random.uniform_float(-1, extent.z + 1)};
}

TEST(VoxelMap, TellsWhatIsWrong) {
    const auto problem = [](std::size_t words, const glm::uvec3& count, const Vec3& cell) {
        const Result<VoxelMap> built = VoxelMap::build(std::vector<std::uint64_t>(words), count, cell);
        EXPECT_FALSE(built);
        return built ? ProblemCode{} : built.problem().code;
    };
    constexpr float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(problem(0, {0, 4, 4}, Vec3(1)), ProblemCode::empty_input);
    EXPECT_EQ(problem(0, {4, 4, 0}, Vec3(1)), ProblemCode::empty_input);
    EXPECT_EQ(problem(1, {65, 1, 1}, Vec3(1)), ProblemCode::bad_argument);
    EXPECT_EQ(problem(2, {4, 4, 4}, Vec3(1)), ProblemCode::bad_argument);
    EXPECT_EQ(problem(1, {0xffffffff, 0xffffffff, 0xffffffff}, Vec3(1)), ProblemCode::too_large);
    EXPECT_EQ(problem(1, {2048, 2048, 1024}, Vec3(1)), ProblemCode::too_large);
    for (const Vec3& cell : {Vec3(0, 1, 1), Vec3(1, -1, 1), Vec3(1, 1, infinity), Vec3(3e38f, 1, 1)})
        EXPECT_EQ(problem(1, {4, 4, 4}, cell), ProblemCode::bad_argument);
}

TEST(VoxelMap, KnowsWhereItsVoxelsAre) {
    // Bits beyond the last voxel are ignored.
    const VoxelMap map = *VoxelMap::build(std::vector<std::uint64_t>{~std::uint64_t{0x2}}, {2, 2, 2}, Vec3(2, 1, 3));
    EXPECT_EQ(map.bits()[0], 0xfdu);
    EXPECT_EQ(map.size(), 8u);
    EXPECT_FALSE(map.at(1, 0, 0));
    EXPECT_TRUE(map.at(0, 1, 1));
    EXPECT_EQ(map.index(0, 1, 1), 6u);
    EXPECT_EQ(map.box(6), (Aabb3{{0, 1, 3}, {2, 2, 6}}));
    EXPECT_EQ(bounds(map), (Aabb3{{0, 0, 0}, {4, 2, 6}}));
    EXPECT_EQ(map.neighbour(0, 0), no_neighbour);  // empty
    EXPECT_EQ(map.neighbour(0, 1), no_neighbour);  // outside
    EXPECT_EQ(map.neighbour(0, 2), 2u);
    EXPECT_EQ(map.neighbour(0, 4), 4u);
    EXPECT_EQ(map.neighbour(4, 5), 0u);
    const auto hit = raycast(Ray3::between({3, 0.5f, -1}, {3, 0.5f, 9}), map);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->feature.part, 5u);
    EXPECT_FLOAT_EQ(hit->point.z, 3);
    const VoxelMap nothing = empty_map({3, 3, 3}, Vec3(1));
    EXPECT_FALSE(overlaps(nothing, Sphere{{1, 1, 1}, 5}));
    EXPECT_EQ(closest(nothing, Vec3(1, 1, 1)).distance, std::numeric_limits<float>::infinity());
}

TEST(VoxelMap, AnswersAsTheBoxesOfItsVoxels) {
    Random random(seed);
    int touching = 0, hits = 0;
    constexpr int maps = 120, queries = 25;
    for (int k = 0; k < maps * queries; ++k) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(k));
        static VoxelMap map = random_map(random);
        if (k % queries == 0) map = random_map(random);
        const Vec3 from = point_around(random, map), to = point_around(random, map);
        const Box3 box{from, Vec3(random.uniform_float(0.1, 0.6)), random.rotation<3>()};
        const Ray3 ray = Ray3::between(from, to);
        float distance = std::numeric_limits<float>::infinity(), fraction = 2, sweep_fraction = 2;
        bool touches = false, inside = false;
        for (const std::uint32_t voxel : solid_voxels(map)) {
            const Aabb3 part = map.box(voxel);
            distance = std::min(distance, closest(box, part).distance);
            touches = touches || overlaps(box, part);
            inside = inside || contains(part, to);
            if (const auto hit = raycast(ray, part)) fraction = std::min(fraction, hit->fraction);
            if (const auto hit = sweep(box, to - from, part)) sweep_fraction = std::min(sweep_fraction, hit->fraction);
        }
        EXPECT_EQ(closest(box, map).distance, distance);
        EXPECT_EQ(overlaps(box, map), touches);
        EXPECT_EQ(contains(map, to), inside);
        const auto hit = raycast(ray, map);
        EXPECT_EQ(hit ? hit->fraction : 2, fraction);
        const auto swept = sweep(box, to - from, map);
        EXPECT_EQ(swept ? swept->fraction : 2, sweep_fraction);
        touching += touches ? 1 : 0;
        hits += hit ? 1 : 0;
    }
    EXPECT_GT(touching, maps * queries / 5);
    EXPECT_LT(touching, maps * queries * 4 / 5);
    EXPECT_GT(hits, maps * queries / 5);
}

/// Rays from far away, along faces and through edges and corners of a map of several blocks.
TEST(VoxelMap, IsHitByRaysThroughCornersAndFromAfar) {
    Random random(seed);
    int hits = 0;
    constexpr int queries = 3000;
    for (int k = 0; k < queries; ++k) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(k));
        static VoxelMap map = random_map(random);
        if (k % 50 == 0) {
            map = empty_map({21, 19, 18}, Vec3(0.7f, 0.3f, 1.1f));
            for (int i = 0; i < 60; ++i) map.set(random.below(map.size()), true);
        }
        const auto on_grid = [&] { return Vec3(random.below(22), random.below(20), random.below(19)) * map.cell(); };
        const Vec3 to = on_grid();
        Vec3 from = on_grid();
        if (random.chance(0.3)) from = to + (from - to) * random.uniform_float(1, 1e5);
        if (random.chance(0.3)) from.x = to.x;
        if (random.chance(0.3)) from.z = to.z;
        const Ray3 ray = Ray3::between(from, to + (to - from));
        float fraction = 2;
        for (const std::uint32_t voxel : solid_voxels(map))
            if (const auto hit = raycast(ray, map.box(voxel))) fraction = std::min(fraction, hit->fraction);
        const auto hit = raycast(ray, map);
        EXPECT_EQ(hit ? hit->fraction : 2, fraction);
        hits += hit ? 1 : 0;
    }
    EXPECT_GT(hits, queries / 20);
}

/// Each solid voxel in a box is visited once, by a small box, which visits cells directly, and by a large one.
TEST(VoxelMap, VisitsThePartsInABox) {
    Random random(seed);
    for (int k = 0; k < 300; ++k) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(k));
        const VoxelMap map = random_map(random);
        const Vec3 a = point_around(random, map), b = k % 2 == 0 ? point_around(random, map) : a + Vec3(0.4f);
        const Aabb3 box{glm::min(a, b), glm::max(a, b)};
        std::vector<std::uint32_t> visited, expected;
        each_part(map, box, [&](const detail::Convex<3>&, std::uint32_t index) {
            visited.push_back(index);
            return true;
        });
        for (const std::uint32_t voxel : solid_voxels(map))
            if (overlaps(map.box(voxel), box)) expected.push_back(voxel);
        std::ranges::sort(visited);
        EXPECT_EQ(visited, expected);
        int count = 0;
        each_part(map, box, [&](const detail::Convex<3>&, std::uint32_t) { return ++count < 2; });
        EXPECT_EQ(count, std::min<int>(2, static_cast<int>(expected.size())));
    }
}

/// The contacts and their normals are those of a compound of the same boxes.
TEST(VoxelMap, TouchesAsACompoundOfItsVoxels) {
    Random random(seed);
    int contacts = 0;
    for (int k = 0; k < 60; ++k) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(k));
        const VoxelMap map = random_map(random);
        std::vector<AnyShape<3>> boxes;
        for (const std::uint32_t voxel : solid_voxels(map)) boxes.emplace_back(map.box(voxel));
        if (boxes.empty()) continue;
        const Compound3 compound = *Compound3::build(boxes);
        for (int i = 0; i < 10; ++i) {
            const Box3 box{point_around(random, map), Vec3(0.4f), i % 2 == 0 ? random.rotation<3>() : no_rotation<3>};
            const auto of = [&](const auto& level) {
                std::vector<Contact<3>> result;
                each_contact(box, level, [&](const Contact<3>& contact) { result.push_back(contact); });
                return result;
            };
            const std::vector<Contact<3>> found = of(map), expected = of(compound);
            ASSERT_EQ(found.size(), expected.size());
            for (std::size_t j = 0; j < found.size(); ++j) {
                EXPECT_EQ(found[j].normal, expected[j].normal);
                EXPECT_EQ(found[j].depth, expected[j].depth);
                EXPECT_EQ(found[j].points.size(), expected[j].points.size());
            }
            contacts += static_cast<int>(found.size());
        }
    }
    EXPECT_GT(contacts, 200);
}

/// A ray from outside hits only faces that are exposed.
TEST(VoxelMap, HasNoFacesBetweenSolidVoxels) {
    Random random(seed);
    int hits = 0;
    for (int k = 0; k < 4000; ++k) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(k));
        static VoxelMap map = random_map(random);
        if (k % 40 == 0) map = random_map(random);
        const Vec3 from = point_around(random, map), to = point_around(random, map);
        if (contains(map, from)) continue;
        const auto hit = raycast(Ray3::between(from, to), map);
        if (!hit) continue;
        ++hits;
        const int axis = std::abs(hit->normal.x) > 0.5f ? 0 : std::abs(hit->normal.y) > 0.5f ? 1 : 2;
        EXPECT_EQ(std::abs(hit->normal[axis]), 1);
        const auto side = static_cast<std::uint32_t>(2 * axis + (hit->normal[axis] < 0 ? 1 : 0));
        EXPECT_EQ(map.neighbour(hit->feature.part, side), no_neighbour);
    }
    EXPECT_GT(hits, 1000);
}

/// A box slides over a floor and touches it with one manifold, whose normal is up: also right after voxels were taken
/// away and put back.
TEST(VoxelMap, IsAFlatFloor) {
    VoxelMap map = floor_of({12, 12, 4}, 2);
    Random random(seed);
    const auto expect_flat = [&](const Vec3& center) {
        const Box3 box{center, Vec3(0.75f, 0.75f, 0.5f)};
        int count = 0;
        each_contact(map, box, [&](const Contact<3>& contact) {
            ++count;
            EXPECT_EQ(contact.normal, Vec3(0, 0, 1));
            EXPECT_GE(contact.points.size(), 1u);
            EXPECT_LE(contact.points.size(), 4u);
        });
        EXPECT_EQ(count, 1);
        const auto hit = sweep(Box3{center + Vec3(0, 0, 1), box.half}, Vec3(1.5f, 0.7f, -3), map);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->normal, Vec3(0, 0, 1));
        EXPECT_FALSE(sweep(Box3{center + Vec3(0, 0, 0.011f), box.half}, Vec3(2, 1.3f, 0), map));
    };
    for (int k = 0; k < 200; ++k) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(k));
        expect_flat({random.uniform_float(2, 8), random.uniform_float(2, 8), 2.49f});
    }
    const Box3 in_pit{{5.5f, 5.5f, 1.9f}, Vec3(0.45f)};
    const std::uint32_t pit = map.index(5, 5, 1);
    for (int k = 0; k < 20; ++k) {
        SCOPED_TRACE(k);
        map.set(pit, false);
        // A box in the pit is free; one that is pushed aside touches the wall, which was within the solid before.
        EXPECT_FALSE(overlaps(map, in_pit));
        const auto wall = sweep(in_pit, Vec3(1, 0, 0), map);
        ASSERT_TRUE(wall);
        EXPECT_EQ(wall->normal, Vec3(-1, 0, 0));
        map.set(pit, true);
        EXPECT_TRUE(overlaps(map, in_pit));
        expect_flat({random.uniform_float(5, 6), random.uniform_float(5, 6), 2.49f});
        // A new block on the floor has walls, and its top is level with that of its neighbour.
        map.set(5, 5, 2, true);
        map.set(6, 5, 2, true);
        const Box3 above{{6, 5.5f, 3.49f}, Vec3(0.5f)};
        int count = 0;
        each_contact(map, above, [&](const Contact<3>& contact) {
            ++count;
            EXPECT_EQ(contact.normal, Vec3(0, 0, 1));
            EXPECT_EQ(contact.points.size(), 4u);
        });
        EXPECT_EQ(count, 1);
        const auto side = sweep(Box3{{2, 5.5f, 2.6f}, Vec3(0.5f)}, Vec3(5, 0, 0), map);
        ASSERT_TRUE(side);
        EXPECT_EQ(side->normal, Vec3(-1, 0, 0));
        map.set(5, 5, 2, false);
        map.set(6, 5, 2, false);
    }
}

}  // namespace
}  // namespace abut
