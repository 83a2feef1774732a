// A solid level as a composite shape: its parts are the solid, and know their brush.

#include "brushes.hpp"
#include "solid_levels.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/world/world.hpp>

#include <array>
#include <iostream>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

template <int D>
const Aabb<D> everywhere{Vec<D>(-std::numeric_limits<float>::max()), Vec<D>(std::numeric_limits<float>::max())};

struct Counts {
    int inside = 0, checked = 0, in_one = 0;
};

/// A point is in a part iff the tree contains it, and in two parts only on their common faces.
template <int D>
void expect_parts_are_the_solid(const SolidBsp<D>& tree, oracle::Random& random, int points, Counts& counts) {
    Aabb<D> box = bounds(tree);
    const Vec<D> extent = box.max - box.min;
    const float margin = 1e-5f * std::max(extent[0], extent[D - 1]);
    for (int i = 0; i < points; ++i) {
        Vec<D> p;
        for (int axis = 0; axis < D; ++axis) p[axis] = box.min[axis] + extent[axis] * random.uniform_float(0, 1);
        float least = std::numeric_limits<float>::infinity();
        int deep_in = 0;
        each_part(tree, everywhere<D>, [&](const Convex<D>& part, std::uint32_t) -> bool {
            const float distance = closest(part, p).distance;
            least = std::min(least, distance);
            deep_in += distance < -margin ? 1 : 0;
            return true;
        });
        EXPECT_NEAR(closest(tree, p).distance, least, 0.1f * margin);
        if (std::abs(least) <= margin) continue;
        ASSERT_EQ(tree.contains(p), least < 0) << p[0] << ' ' << p[1] << ' ' << p[D - 1];
        EXPECT_EQ(contains(tree, p), least < 0);
        EXPECT_EQ(overlaps(tree, Ball<D>{p, 0.5f * margin}), least < 0);
        counts.inside += least < 0 ? 1 : 0;
        counts.in_one += deep_in == 1 ? 1 : 0;
        ++counts.checked;
    }
}

TEST(SolidParts, OfOutlinesAreTheSolid) {
    oracle::Random random(81);
    Counts counts;
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 81 level " << i);
        abut::test::Level<2> level;
        for (int k = 0; k < 3; ++k)
            add_outline(level,
                        star(random, 4 + static_cast<int>(random.below(20)), Vec2(random.in_cube<2>() * 6.0), 2, 8));
        if (i % 2 == 0) snap(level);
        if (i % 5 == 0) turn_around(level);
        expect_parts_are_the_solid(level.tree(), random, 60, counts);
        if (HasFailure()) return;
    }
    EXPECT_EQ(counts.in_one, counts.inside) << "cells don't overlap";
    EXPECT_GT(counts.inside, counts.checked / 4);
    EXPECT_LT(counts.inside, counts.checked * 9 / 10);
}

TEST(SolidParts, OfSurfacesAreTheSolid) {
    oracle::Random random(82);
    Counts counts;
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 82 level " << i);
        Surface surface = random_terrain(random, 5, 3).solid(-1);
        if (i % 4 == 0) surface = cell_surface(4, [&](int, int, int) { return random.chance(0.5); });
        if (i % 4 == 1) {
            surface = {};
            for (int k = 0; k < 5; ++k) {
                const Vec3 low(random.in_cube<3>() * 4.0);
                surface = joined(surface, box_surface(low, low + Vec3(random.in_cube<3>() * 2.0) + Vec3(3)));
            }
        }
        if (i % 5 == 0) surface = joined(surface, reversed(box_surface(Vec3(-9), Vec3(12))));
        expect_parts_are_the_solid(level_of(surface).tree(), random, 100, counts);
        if (HasFailure()) return;
    }
    EXPECT_EQ(counts.in_one, counts.inside) << "cells don't overlap";
    EXPECT_GT(counts.inside, counts.checked / 4);
    EXPECT_LT(counts.inside, counts.checked * 9 / 10);
}

/// Three brushes; the second has no volume.
template <int D>
SolidBsp<D> three_brushes() {
    std::vector<HalfSpace<D>> sides;
    std::vector<std::uint32_t> ends;
    add_brush<D>(Vec<D>(0.0f), Vec<D>(4.0f), sides, ends);
    add_brush<D>(Vec<D>(7.0f), Vec<D>(6.0f), sides, ends);
    Vec<D> low(1.0f), high(3.0f);
    low[0] = 4;
    high[0] = 10;
    add_brush<D>(low, high, sides, ends);
    return *SolidBsp<D>::from_brushes(sides, ends);
}

template <int D>
void expect_known_brushes() {
    const SolidBsp<D> level = three_brushes<D>();
    EXPECT_EQ(level.part_count(), 2u);
    Vec<D> low(0.0f), high(4.0f);
    high[0] = 10;
    EXPECT_EQ(bounds(level), (Aabb<D>{low, high}));
    // A ball within is deep, by its least depth in a brush.
    Vec<D> center(2.0f);
    center[0] = 1.5f;
    const Contact<D> deep = contact(level, Ball<D>{center, 0.25f});
    ASSERT_TRUE(deep);
    EXPECT_NEAR(deep.depth, 1.75, 1e-6);
    EXPECT_EQ(deep.feature_a.part, 0u);
    center[0] = 7;
    center[1] = 2.75f;
    const Closest<D> nearest = closest(level, Ball<D>{center, 0.25f});
    EXPECT_NEAR(nearest.distance, -0.5, 1e-6);
    EXPECT_EQ(nearest.feature_a.part, 2u) << "the one left out is counted";
    EXPECT_NEAR(nearest.normal[1], 1, 1e-6);
    center[1] = 5;
    Vec<D> motion(0.0f);
    motion[1] = -4;
    const auto hit = sweep(Ball<D>{center, 0.25f}, motion, level);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction, 1.75 / 4, 1e-6);
    EXPECT_EQ(hit->feature.part, 2u);
    // The level's own raycast reports the side; that of its parts reports the brush.
    const Ray<D> ray = Ray<D>::between(center, center + motion);
    const auto side = raycast(ray, level), brush = raycast(ray, at(level, Pose<D>{}));
    ASSERT_TRUE(side && brush);
    EXPECT_EQ(side->distance, 2);
    EXPECT_EQ(brush->distance, 2);
    EXPECT_EQ(side->feature.part, 4u * D + 2);
    EXPECT_EQ(brush->feature.part, 2u);
    EXPECT_EQ(level.nearest_face(brush->point), side->feature.part);
}

TEST(SolidParts, AreTheLumpsByNumber) {
    expect_known_brushes<2>();
    expect_known_brushes<3>();
}

TEST(SolidParts, OfARoomExtendBeyondItsWalls) {
    const SolidBsp3 hollow = level_of(reversed(box_surface({0, 0, 0}, {4, 2, 2}))).tree();
    EXPECT_EQ(hollow.bounds(), (Aabb3{{0, 0, 0}, {4, 2, 2}}));
    EXPECT_EQ(bounds(hollow), (Aabb3{{-4, -4, -4}, {8, 6, 6}}));
    EXPECT_NEAR(closest(hollow, Vec3(1, 1, 1.25f)).distance, 0.75, 1e-6);
    EXPECT_NEAR(contact(hollow, Sphere{{1, 1, 2.5f}, 0.25f}).depth, 0.75, 1e-6);
    EXPECT_NEAR(sweep(Sphere{{1, 1, 1}, 0.5f}, Vec3(0, 0, -9), hollow)->fraction, 0.5 / 9, 1e-6);
    EXPECT_TRUE(hollow.contains(Vec3(100)));
    // Behind open geometry the solid extends as far.
    const SolidBsp2 wall = *SolidBsp2::build(std::vector<Vec2>{{0, 0}, {4, 0}}, std::vector<glm::uvec2>{{0, 1}});
    EXPECT_EQ(bounds(wall), (Aabb2{{-4, 0}, {8, 4}}));
    EXPECT_NEAR(closest(wall, Vec2(7, 1)).distance, -1, 1e-6);
}

TEST(SolidParts, OfNothingAreNone) {
    const SolidBsp3 nothing = *SolidBsp3::build(std::vector<Vec3>(3, Vec3(1)), std::vector<glm::uvec3>{{0, 1, 2}});
    EXPECT_EQ(nothing.part_count(), 0u);
    EXPECT_EQ(bounds(nothing), Aabb3::empty());
    EXPECT_EQ(closest(nothing, Vec3(0)).distance, std::numeric_limits<float>::infinity());
    EXPECT_FALSE(overlaps(nothing, Sphere{{1, 1, 1}, 1}));
    EXPECT_EQ(nothing.nearest_face(Vec3(0)), std::nullopt);
    World3 world;
    world.add(nothing, {.fixed = true});
    world.add(Sphere{{1, 1, 1}, 1});
    EXPECT_TRUE(world.update().began.empty());
}

/// Where floats are coarse a part keeps its form: its corners are relative to its own frame.
TEST(SolidParts, FarFromTheOriginKeepTheirForm) {
    const float far = 1 << 16;
    std::vector<HalfSpace3> sides;
    std::vector<std::uint32_t> ends;
    add_brush<3>(Vec3(far), Vec3(far + 1), sides, ends);
    const Vec3 slope(0.6f, 0.8f, 0);  // cut off in the middle
    sides.push_back({slope, dot(slope, Vec3(far + 0.5f))});
    ends.back() = static_cast<std::uint32_t>(sides.size());
    const SolidBsp3 level = *SolidBsp3::from_brushes(sides, ends);
    int corners = 0;
    each_part(level, everywhere<3>, [&](const Convex<3>& part, std::uint32_t) -> bool {
        for (std::uint32_t i = 0; i < part.count; ++i) {
            const DVec<3> corner = part.place.point(DVec<3>(part.vertices()[i]));
            double nearest = 1;
            for (const HalfSpace3& side : sides)
                if (side.normal == slope)
                    nearest = std::abs(dot(DVec<3>(slope), corner) - static_cast<double>(side.offset));
            if (nearest < 0.05) ++corners;
            EXPECT_TRUE(nearest < 1e-6 || nearest > 0.05) << nearest;
        }
        return true;
    });
    EXPECT_EQ(corners, 4);
}

template <int D>
void expect_nearest_face(const abut::test::Level<D>& level, oracle::Random& random, int points, int& unsure) {
    const SolidBsp<D> tree = level.tree();
    const auto distance_to = [&](std::size_t face, const Vec<D>& p) {
        if constexpr (D == 2)
            return closest(Segment2{level.corner(face, 0), level.corner(face, 1)}, p).distance;
        else
            return closest(Triangle3{level.corner(face, 0), level.corner(face, 1), level.corner(face, 2)}, p).distance;
    };
    for (int i = 0; i < points; ++i) {
        const Vec<D> p(random.in_cube<D>() * 10.0);
        float least = std::numeric_limits<float>::infinity();
        std::size_t nearest = 0;
        for (std::size_t face = 0; face < level.faces.size(); ++face)
            if (const float distance = distance_to(face, p); distance < least) {
                least = distance;
                nearest = face;
            }
        const auto reported = tree.nearest_face(p);
        ASSERT_TRUE(reported);
        EXPECT_NEAR(distance_to(*reported, p), least, 1e-5);
        unsure += *reported == nearest ? 0 : 1;
    }
}

TEST(SolidParts, TheNearestFaceIsThatOfAll) {
    oracle::Random random(83);
    int unsure = 0;
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 83 level " << i);
        abut::test::Level<2> flat;
        for (int k = 0; k < 3; ++k) add_outline(flat, star(random, 12, Vec2(random.in_cube<2>() * 6.0), 2, 8));
        expect_nearest_face(flat, random, 30, unsure);
        Surface surface;
        for (int k = 0; k < 4; ++k) {
            const Vec3 low(random.in_cube<3>() * 4.0);
            surface = joined(surface, box_surface(low, low + Vec3(random.in_cube<3>() * 2.0) + Vec3(3)));
        }
        expect_nearest_face(level_of(surface), random, 30, unsure);
        if (HasFailure()) return;
    }
    // Corners and edges have several.
    EXPECT_LT(unsure, 20 * 60 / 3);
}

TEST(SolidParts, InACompoundAndAWorldAreItsOwn) {
    const SolidBsp3 level = three_brushes<3>();
    const Compound3 two = *Compound3::build({level, at(stretched(level, Vec3(-1, 1, 1)), Pose3{{0, 0, 20}})});
    EXPECT_EQ(contact(two, Sphere{{2, 2, 0.5f}, 0.1f}).feature_a.part, 0u);
    EXPECT_EQ(closest(two, Vec3(-9, 2, 22)).feature_a.part, 1u);
    EXPECT_TRUE(contains(two, Vec3(-9, 2, 22)));
    EXPECT_FALSE(contains(two, Vec3(9, 2, 22)));
    World3 world;
    const Id fixed = world.add(level, {.pose = Pose3{{0, 0, 1}}, .fixed = true});
    const Id ball = world.add(Sphere{{0, 0, 0}, 0.5f}, {.pose = Pose3{{7, 2, 4.25f}}});
    world.update();
    ASSERT_EQ(world.contacts().size(), 1u);
    EXPECT_NEAR(world.contacts()[0].contact.depth, 0.25, 1e-6);
    EXPECT_EQ(world.containing({2, 2, 2}), std::vector<Id>{fixed});
    EXPECT_EQ(world.raycast(Ray3::between({7, 2, 20}, {7, 2, 4}))->id, ball);
}

/// A world finds nothing beyond the bounds of a shape, where the tree of a room once contained all of space.
TEST(SolidParts, SolidAroundARoomContainsWhatItsPartsDo) {
    const std::vector<Vec2> points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const std::vector<glm::uvec2> faces{{1, 0}, {2, 1}, {3, 2}, {0, 3}};
    const SolidBsp2 hollow = *SolidBsp2::build(points, faces);
    EXPECT_FALSE(contains(hollow, Vec2(0, 0)));
    EXPECT_TRUE(contains(hollow, Vec2(1.5f, 0)));
    EXPECT_TRUE(hollow.contains({1000, 0}));
    EXPECT_FALSE(contains(hollow, Vec2(1000, 0)));
    EXPECT_FALSE(overlaps(hollow, Circle{{1000, 0}, 1}));
}

}  // namespace
}  // namespace abut::test
