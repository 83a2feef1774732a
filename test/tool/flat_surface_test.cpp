#include "tool/objects/flat_surface.hpp"

#include "../oracle/random.hpp"
#include <abut/abut.hpp>
#include <abut/io/outlines.hpp>

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace abut::tool {
namespace {

Segment2 segment(const Surface<2>& surface, std::size_t facet) {
    return {surface.points[surface.facets[facet][0]], surface.points[surface.facets[facet][1]]};
}

float length_of(const Surface<2>& surface) {
    float sum = 0;
    for (std::size_t i = 0; i < surface.facets.size(); ++i) {
        const Segment2 s = segment(surface, i);
        sum += glm::distance(s.a, s.b);
    }
    return sum;
}

// The shape is on the left of each of its edges, and at some point of it not on the right.
template <class S>
void expect_fronts_are_free(const S& shape, const Surface<2>& surface, float away) {
    for (std::size_t i = 0; i < surface.facets.size(); ++i) {
        const Segment2 s = segment(surface, i);
        const Vec2 along = glm::normalize(s.b - s.a), right(along.y, -along.x);
        bool free = false;
        for (const float fraction : {0.25f, 0.5f, 0.75f})
            free = free || !contains(shape, s.a + fraction * (s.b - s.a) + away * right);
        EXPECT_TRUE(free) << i;
        EXPECT_TRUE(surface.is_two_sided(i) || contains(shape, s.a + 0.5f * (s.b - s.a) - away * right)) << i;
    }
}

TEST(FlatSurface, ConvexShapesByTheirCorners) {
    const Box2 box{{3, 4}, {2, 1}, Turn()};
    const Surface<2> surface = *surface_of(view(box), true);
    EXPECT_EQ(surface.points.size(), 4u);
    ASSERT_EQ(surface.facets.size(), 4u);
    EXPECT_FLOAT_EQ(length_of(surface), 12);
    expect_fronts_are_free(box, surface, 0.01f);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_FALSE(surface.is_two_sided(i));
}

TEST(FlatSurface, CurvesByLinesWithinTheirTolerance) {
    const Circle circle{{100, -20}, 8};
    const Surface<2> surface = *surface_of(view(circle), true);
    EXPECT_GT(surface.facets.size(), 50u);
    EXPECT_LT(surface.facets.size(), 500u);
    for (std::size_t i = 0; i < surface.facets.size(); ++i) {
        const Segment2 s = segment(surface, i);
        const double off = 8 - static_cast<double>(glm::distance((s.a + s.b) * 0.5f, circle.center));
        EXPECT_GE(off, -1e-5);
        EXPECT_LE(off, 16 * 1.001e-4);
    }
}

TEST(FlatSurface, TilesHaveNoEdgesBetweenThem) {
    // A floor with a slope and a half, moved and rotated: coordinates are rounded tile by tile.
    const std::vector<Tile> tiles{Tile::empty,     Tile::full, Tile::slope_high_x_high_y,
                                  Tile::empty,  //
                                  Tile::full,      Tile::full, Tile::full,
                                  Tile::half_low_x};
    const Result<TileMap> map = TileMap::build(tiles, 4, 0.7f);
    ASSERT_TRUE(map);
    for (const Pose2& pose : {Pose2(), Pose2{{1234.567f, -89.01f}, Turn{0.8f, 0.6f}}}) {
        const auto placed = at(*map, pose);
        const Surface<2> surface = *surface_of(view(placed), true);
        expect_fronts_are_free(placed, surface, 0.01f);
        // Above, the full tile has three free sides, the slope its own and one more. Below, there are the left side,
        // that of the tile without one above it, three and a half below and half a side above, and the right side.
        EXPECT_NEAR(length_of(surface), 0.7f * (3 + 1.41421356f + 1 + 1 + 1 + 3.5f + 0.5f + 1), 1e-3);
    }
    const std::vector<Tile> block(12, Tile::full);
    const Surface<2> surface = *surface_of(view(*TileMap::build(block, 4, 2)), true);
    EXPECT_EQ(surface.facets.size(), 14u);
    EXPECT_FLOAT_EQ(length_of(surface), 28);
}

TEST(FlatSurface, OneWayTilesAndOpenLinesAreFreeOnBothSides) {
    const std::vector<Tile> tiles{Tile::one_way_low_y, Tile::empty, Tile::full};
    const Surface<2> surface = *surface_of(view(*TileMap::build(tiles, 3, 1)), true);
    ASSERT_EQ(surface.facets.size(), 5u);
    EXPECT_TRUE(surface.is_two_sided(0));
    for (std::size_t i = 1; i < 5; ++i) EXPECT_FALSE(surface.is_two_sided(i));
    const Result<Chain> line = Chain::build({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, true);
    const Surface<2> lines = *surface_of(view(*line), false);
    ASSERT_EQ(lines.facets.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(lines.is_two_sided(i));
}

TEST(FlatSurface, WhatLinesGoAroundIsBehindThem) {
    // A wall with a hole, with either winding of both.
    for (const bool turned : {false, true})
        for (const bool hole_turned : {false, true}) {
            std::vector<Vec2> outer{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, inner{{3, 3}, {6, 3}, {6, 6}, {3, 6}};
            if (turned) std::reverse(outer.begin(), outer.end());
            if (hole_turned) std::reverse(inner.begin(), inner.end());
            const Outlines wall{{*Chain::build(outer, true), *Chain::build(inner, true)}, FillRule::even_odd};
            const Surface<2> surface = *surface_of(view(wall), true);
            EXPECT_EQ(surface.facets.size(), 8u);
            expect_fronts_are_free(wall, surface, 0.05f);
            for (std::size_t i = 0; i < 8; ++i) EXPECT_FALSE(surface.is_two_sided(i));
        }
}

// No path enters random tiles, or a compound of tiles and a polygon, without crossing an edge.
TEST(FlatSurface, IsCrossedByAllPathsIn) {
    constexpr std::uint64_t seed = 20260;
    oracle::Random random(seed);
    int crossings = 0;
    for (int round = 0; round < 20; ++round) {
        std::vector<Tile> tiles(30);
        for (Tile& tile : tiles) tile = static_cast<Tile>(random.below(10));
        const Result<TileMap> map = TileMap::build(tiles, 6, 1.0f);
        const Result<Polygon> polygon = Polygon::build({{1.3f, 1.2f}, {4.1f, 1.9f}, {2.2f, 4.4f}});
        const Result<Compound2> compound = Compound2::build({AnyShape<2>(*map), AnyShape<2>(*polygon)});
        ASSERT_TRUE(compound);
        const Surface<2> surface = *surface_of(view(*compound), true);
        for (int i = 0; i < 200; ++i) {
            const Vec2 from(random.uniform_float(-1, 7), random.uniform_float(-1, 6)),
                to(random.uniform_float(-1, 7), random.uniform_float(-1, 6));
            if (contains(*compound, from) == contains(*compound, to)) continue;
            ++crossings;
            bool crossed = false;
            for (std::size_t k = 0; k < surface.facets.size(); ++k)
                crossed = crossed || overlaps(Segment2{from, to}, segment(surface, k));
            EXPECT_TRUE(crossed) << "seed " << seed << ", round " << round;
        }
    }
    EXPECT_GT(crossings, 500);
}

}  // namespace
}  // namespace abut::tool
