#include <abut/bake/solid.hpp>
#include <abut/shape/weld.hpp>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

Welded box_around(const Vec3& half, const Vec3& middle = {}) {
    Welded result;
    for (int i = 0; i < 8; ++i)
        result.points.push_back(middle +
                                half * Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
    result.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return result;
}

// A ball of rings and segments, its surface pressed in by `dent` at the pole of +z, over the upper `reach` of its
// rings.
Welded ball(int rings, float dent = 0, float reach = 0.1f) {
    Welded result;
    const auto ring = [&](int i) {
        const double angle = std::numbers::pi * i / rings;
        const double pressed = std::max(0.0, 1 - i / (static_cast<double>(reach) * rings));
        const double height = std::cos(angle) - static_cast<double>(dent) * pressed * pressed;
        return std::pair(std::sin(angle), height);
    };
    const int segments = 2 * rings;
    result.points.push_back({0, 0, static_cast<float>(ring(0).second)});
    for (int i = 1; i < rings; ++i)
        for (int k = 0; k < segments; ++k) {
            const double turn = 2 * std::numbers::pi * k / segments;
            const auto [radius, height] = ring(i);
            result.points.push_back({static_cast<float>(radius * std::cos(turn)),
                                     static_cast<float>(radius * std::sin(turn)), static_cast<float>(height)});
        }
    result.points.push_back({0, 0, -1});
    const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(1 + (i - 1) * segments + k % segments); };
    const auto last = static_cast<std::uint32_t>(result.points.size() - 1);
    for (int k = 0; k < segments; ++k) {
        result.triangles.emplace_back(0, at(1, k), at(1, k + 1));
        for (int i = 1; i + 1 < rings; ++i) {
            result.triangles.emplace_back(at(i, k), at(i + 1, k), at(i + 1, k + 1));
            result.triangles.emplace_back(at(i, k), at(i + 1, k + 1), at(i, k + 1));
        }
        result.triangles.emplace_back(at(rings - 1, k), last, at(rings - 1, k + 1));
    }
    return result;
}

Welded joined(Welded a, const Welded& b) {
    const auto shift = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const glm::uvec3& t : b.triangles) a.triangles.push_back(t + shift);
    return a;
}

Welded inside_out(Welded a) {
    for (glm::uvec3& t : a.triangles) std::swap(t.y, t.z);
    return a;
}

bool solid(const Welded& a) {
    return is_convex_solid(a.points, a.triangles);
}

TEST(Solid, BoxesAndBallsAreSolid) {
    for (const float scale : {1e-3f, 1.0f, 1e4f}) {
        EXPECT_TRUE(solid(box_around(Vec3(1, 2, 3) * scale))) << scale;
        EXPECT_TRUE(solid(box_around(Vec3(1, 2, 3) * scale, Vec3(50, -70, 90) * scale))) << scale;
    }
    EXPECT_TRUE(solid(ball(4)));
    EXPECT_TRUE(solid(ball(30)));
}

TEST(Solid, WhatIsSeenFromInsideIsNot) {
    EXPECT_FALSE(solid(inside_out(box_around({1, 2, 3}))));
    EXPECT_FALSE(solid(inside_out(ball(8))));
}

TEST(Solid, OneTriangleTurnedOrMissingIsNot) {
    for (std::size_t i = 0; i < 12; ++i) {
        Welded turned = box_around({1, 1, 1});
        std::swap(turned.triangles[i].y, turned.triangles[i].z);
        EXPECT_FALSE(solid(turned)) << i;
        Welded open = box_around({1, 1, 1});
        open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_FALSE(solid(open)) << i;
    }
}

TEST(Solid, SeveralBodiesAreNot) {
    const Welded twice = joined(box_around({1, 1, 1}), box_around({1, 1, 1}));
    EXPECT_FALSE(solid(weld(twice.points, twice.triangles)));
    EXPECT_FALSE(solid(joined(box_around({1, 1, 1}), box_around({1, 1, 1}, {5, 0, 0}))));
    EXPECT_FALSE(solid(joined(box_around({1, 1, 1}), box_around({2, 2, 2}))));
    EXPECT_FALSE(solid(joined(box_around({1, 1, 1}), box_around({1, 1, 1}, {1, 1, 1}))));
}

TEST(Solid, FlatThingsAreNot) {
    const Welded sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}}};
    EXPECT_FALSE(solid(sheet));
    EXPECT_FALSE(solid(Welded{}));
    // A lens thinner than the tolerance: only the volume decides which side is inside.
    const Welded lens{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1e-6f}, {0, 0, -1e-6f}},
                      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
    EXPECT_TRUE(solid(lens));
    EXPECT_FALSE(solid(inside_out(lens)));
}

TEST(Solid, BendsWithinTheMarginAreForgiven) {
    // The size of this box_around is sqrt(3), so the margin 1.7e-5.
    Welded pressed = joined(box_around({1, 1, 1}), {});
    pressed.points.push_back({0, 0, 1});
    pressed.triangles[2] = {4, 5, 8};
    pressed.triangles[3] = {5, 7, 8};
    pressed.triangles.push_back({7, 6, 8});
    pressed.triangles.push_back({6, 4, 8});
    EXPECT_TRUE(solid(pressed));
    pressed.points[8].z = 1 - 5e-6f;
    EXPECT_TRUE(solid(pressed));
    pressed.points[8].z = 1 - 4e-5f;
    EXPECT_FALSE(solid(pressed));
    pressed.points[8].z = 1.2f;
    EXPECT_TRUE(solid(pressed));
}

TEST(Solid, AFineDentOfWhichEveryEdgePassesIsFound) {
    EXPECT_TRUE(solid(ball(60)));
    EXPECT_FALSE(solid(ball(60, 0.03f, 0.4f)));
}

}  // namespace
}  // namespace abut
