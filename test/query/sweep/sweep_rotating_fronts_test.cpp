// Sweeps with rotation at one-sided shapes: segments of a chain, one-way tiles, a triangle in 3D.

#include <abut/query/closest.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/triangle.hpp>

#include <numbers>

#include <gtest/gtest.h>

namespace abut {
namespace {

Chain chain(std::initializer_list<Vec2> points, bool one_sided = true) {
    return *Chain::build(points, false, {.one_sided = one_sided});
}

/// A rod of length 2 about its end.
const Box2 rod{{1, 0}, {1, 0.05f}};

TEST(SweepRotatingFronts, ARodMeetsAWallFromItsFrontAlone) {
    // The front of the wall faces right.
    const std::initializer_list<Vec2> up{{0, 1}, {0, 3}};
    const Motion2 from_front{{}, {}, std::numbers::pi_v<float>},
        from_back{{{0, 0}, Turn::by(std::numbers::pi_v<float>)}, {}, -std::numbers::pi_v<float>};
    for (const bool one_sided : {false, true}) {
        const Chain wall = chain(up, one_sided);
        const auto at_front = sweep(rod, from_front, wall);
        ASSERT_TRUE(at_front);
        // The rod's upper side hits the segment's lower end, at a distance of 1.
        EXPECT_NEAR(at_front->fraction * std::numbers::pi_v<float>, std::numbers::pi_v<float> / 2 - std::asin(0.05),
                    1e-4);
        EXPECT_GT(at_front->normal.x, 0.99f);
        EXPECT_EQ(sweep(rod, from_back, wall).has_value(), !one_sided);
        // Now the wall rotates.
        EXPECT_TRUE(sweep(wall, Motion2{{}, {}, -std::numbers::pi_v<float>}, rod));
        EXPECT_EQ(sweep(wall, Motion2{{}, {}, std::numbers::pi_v<float>}, rod,
                        Motion2{{{0, 0}, Turn::by(std::numbers::pi_v<float>)}, {}, 0})
                      .has_value(),
                  !one_sided);
    }
}

// A ball that circles around a point at height 0 passes up through a platform at height 1, and hits it from above on
// the other side.

/// The angle at which a ball of radius 0.1 on a circle of radius 2 comes down to height 1.
const double comes_down = static_cast<double>(std::numbers::pi_v<float>) - std::asin(1.1 / 2);

template <int D>
Motion<D> circling() {
    if constexpr (D == 2)
        return {{}, {}, -2 * std::numbers::pi_v<float>};
    else
        return {{}, {}, {0, 2 * std::numbers::pi_v<float>, 0}};
}
template <int D>
Ball<D> circler() {
    Ball<D> result{Vec<D>(0.0f), 0.1f};
    result.center[0] = -2;
    return result;
}

template <int D>
void expect_met_from_above(const std::optional<Hit<D>>& hit) {
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction * 2 * std::numbers::pi_v<float>, comes_down, 1e-4);
    EXPECT_NEAR(hit->normal[D - 1], 1, 1e-4);
    EXPECT_NEAR(hit->point[D - 1], 1, 1e-4);
    EXPECT_FALSE(hit->started_inside);
}
template <int D>
void expect_met_from_below(const std::optional<Hit<D>>& hit) {
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction * 2 * std::numbers::pi_v<float>, std::asin(0.9 / 2), 1e-4);
    EXPECT_NEAR(hit->normal[D - 1], -1, 1e-4);
}

TEST(SweepRotatingFronts, APlatformIsPassedFromBelowAndMetFromAbove) {
    const Circle ball = circler<2>();
    const Motion2 motion = circling<2>();
    expect_met_from_above(sweep(ball, motion, chain({{3, 1}, {-3, 1}})));
    expect_met_from_below(sweep(ball, motion, chain({{-3, 1}, {3, 1}})));
    expect_met_from_below(sweep(ball, motion, chain({{3, 1}, {-3, 1}}, false)));
    // A chain of several segments, and a single segment as a part.
    expect_met_from_above(sweep(ball, motion, chain({{3, 1}, {1, 1}, {-1.5f, 1}, {-3, 1}})));
    detail::Convex<2> part = convex(Segment2{{3, 1}, {-3, 1}});
    part.one_sided = true;
    expect_met_from_above(sweep(convex(ball), motion, part, Motion2{}));
    // The segment is a part of a compound with other parts, and with a floor below.
    expect_met_from_above(sweep(ball, motion, *Compound<2>::build({AnyShape<2>(chain({{3, 1}, {-3, 1}}))})));
    // The segment is the edge of a tile.
    const TileMap tiles = *TileMap::build(std::vector<Tile>(6, Tile::one_way_high_y), 6, Vec2(1));
    expect_met_from_above(sweep(ball, motion, at(tiles, Pose2{{-3, 0}})));
    const TileMap others = *TileMap::build(std::vector<Tile>(6, Tile::one_way_low_y), 6, Vec2(1));
    expect_met_from_below(sweep(ball, motion, at(others, Pose2{{-3, 1}})));
}

TEST(SweepRotatingFronts, APlatformThatAHalfSpaceTurnsIntoHasAFront) {
    // A ceiling that swings down about the origin.
    const HalfSpace2 ceiling{{0, -1}, 0};
    const Motion2 motion{{}, {}, 0.9f * std::numbers::pi_v<float>};
    detail::Convex<2> up = convex(Segment2{{-2, -1}, {-3, -1}}), down = convex(Segment2{{-3, -1}, {-2, -1}});
    up.one_sided = down.one_sided = true;
    EXPECT_TRUE(sweep(View<2>(view(ceiling)), motion, View<2>(up), Motion2{}));
    EXPECT_FALSE(sweep(View<2>(view(ceiling)), motion, View<2>(down), Motion2{}));
    EXPECT_TRUE(sweep(View<2>(up), Motion2{}, View<2>(view(ceiling)), motion));
    EXPECT_FALSE(sweep(View<2>(down), Motion2{}, View<2>(view(ceiling)), motion));
}

TEST(SweepRotatingFronts, ATriangleInSpaceOfAUserHasAFront) {
    detail::Convex<3> up = convex(Triangle3{{-6, -6, 1}, {6, -6, 1}, {0, 9, 1}});
    up.one_sided = true;
    detail::Convex<3> down = convex(Triangle3{{-6, -6, 1}, {0, 9, 1}, {6, -6, 1}});
    down.one_sided = true;
    const Sphere ball = circler<3>();
    const Motion3 motion = circling<3>();
    expect_met_from_above(sweep(convex(ball), motion, up, Motion3{}));
    expect_met_from_below(sweep(convex(ball), motion, down, Motion3{}));
    expect_met_from_above(sweep(View<3>(view(ball)), motion, View<3>(up), Motion3{}));
    // A box goes through as well, and stands on it with an edge.
    const Box3 box{{-2, 0, 0}, {0.1f, 0.1f, 0.1f}};
    const auto hit = sweep(convex(box), motion, up, Motion3{});
    ASSERT_TRUE(hit);
    EXPECT_GT(hit->normal.z, 0.999f);
    EXPECT_GT(hit->fraction * 2 * std::numbers::pi_v<float>, std::numbers::pi_v<float> / 2);
    EXPECT_LT(sweep(convex(box), motion, down, Motion3{})->normal.z, -0.999f);
}

// Sweeps that start inside.

TEST(SweepRotatingFronts, WhatIsInItFromTheBackGoesOnAndIsMetWhenItComesBack) {
    const Chain platform = chain({{3, 0}, {-3, 0}});
    const Circle below{{-2, -0.05f}, 0.1f}, above{{-2, 0.05f}, 0.1f};
    const Motion2 up = circling<2>(), down{{}, {}, 2 * std::numbers::pi_v<float>};
    const auto after = [&](const Circle& ball, const Motion2& motion) {
        const auto hit = sweep(ball, motion, platform);
        EXPECT_TRUE(hit && hit->started_inside);
        return hit ? hit->fraction : -1;
    };
    // The motion goes up and around, and down on the other side. It leaves from above as well.
    EXPECT_NEAR(after(below, up), 0.5, 0.05);
    EXPECT_NEAR(after(above, up), 0.5, 0.05);
    // Down from the upper side is a hit at once; from the lower side it leaves, and comes up on the other one.
    EXPECT_EQ(after(above, down), 0);
    EXPECT_NEAR(after(below, down), 1, 0.05);
}

}  // namespace
}  // namespace abut
