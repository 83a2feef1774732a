#include "../oracle/random.hpp"
#include <abut/math/dvec.hpp>
#include <abut/shape/polygon.hpp>

#include <array>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace {

using abut::Polygon;
using abut::ProblemCode;
using abut::Vec2;
using abut::detail::DVec;

std::vector<Vec2> corners(const Polygon& polygon) {
    return {polygon.points().begin(), polygon.points().end()};
}

TEST(Polygon, IsTheOriginUnlessBuilt) {
    const Polygon polygon;
    EXPECT_EQ(corners(polygon), std::vector<Vec2>{Vec2(0)});
    EXPECT_EQ(polygon.rank(), 0);
    EXPECT_EQ(polygon.area(), 0);
    EXPECT_EQ(polygon.centroid(), Vec2(0));
}

TEST(Polygon, OfASquareWithPointsInsideAndOnEdges) {
    const auto polygon = Polygon::build({{1, 1}, {0.5f, 0.5f}, {0, 0}, {0, 1}, {0.5f, 0}, {1, 0}, {1, 1}, {0, 0.25f}});
    ASSERT_TRUE(polygon);
    EXPECT_EQ(corners(*polygon), (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(polygon->rank(), 2);
    EXPECT_EQ(polygon->area(), 1);
    EXPECT_EQ(polygon->centroid(), Vec2(0.5f, 0.5f));
}

TEST(Polygon, OfATriangle) {
    const auto polygon = Polygon::build({{0, 3}, {6, 0}, {0, 0}});
    EXPECT_EQ(corners(*polygon), (std::vector<Vec2>{{0, 0}, {6, 0}, {0, 3}}));
    EXPECT_EQ(polygon->area(), 9);
    EXPECT_EQ(polygon->centroid(), Vec2(2, 1));
}

TEST(Polygon, OfOnePointManyTimes) {
    const auto polygon = Polygon::build({{3, -4}, {3, -4}, {3, -4}});
    EXPECT_EQ(corners(*polygon), (std::vector<Vec2>{{3, -4}}));
    EXPECT_EQ(polygon->rank(), 0);
    EXPECT_EQ(polygon->area(), 0);
    EXPECT_EQ(polygon->centroid(), Vec2(3, -4));
}

TEST(Polygon, OfPointsOnALineIsASegment) {
    const auto polygon = Polygon::build({{1, 2}, {5, 10}, {3, 6}, {-1, -2}, {3, 6}});
    EXPECT_EQ(corners(*polygon), (std::vector<Vec2>{{-1, -2}, {5, 10}}));
    EXPECT_EQ(polygon->rank(), 1);
    EXPECT_EQ(polygon->area(), 0);
    EXPECT_EQ(polygon->centroid(), Vec2(2, 4));
}

// Tenths aren't floats: these points are collinear only before rounding.
TEST(Polygon, OfPointsOnALineButForRoundingIsASegment) {
    std::vector<Vec2> points;
    for (int i = 0; i <= 10; ++i) points.emplace_back(static_cast<float>(i * 0.1), static_cast<float>(i * 0.3));
    const auto polygon = Polygon::build(points);
    EXPECT_EQ(corners(*polygon), (std::vector<Vec2>{points.front(), points.back()}));
    const auto thicker = Polygon::build({{0, 0}, {1, 0}, {0.5f, 1e-6f}});
    EXPECT_EQ(thicker->rank(), 2);
    EXPECT_NEAR(thicker->area(), 5e-7, 1e-12);
}

TEST(Polygon, OfNothingIsAProblem) {
    for (const auto& polygon : {Polygon::build({}), Polygon::build(std::vector<Vec2>())}) {
        ASSERT_FALSE(polygon);
        EXPECT_EQ(polygon.problem().code, ProblemCode::empty_input);
        EXPECT_FALSE(polygon.problem().message.empty());
    }
}

TEST(Polygon, NamesThePointThatIsNotFinite) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()})
        for (const Vec2& point : {Vec2(bad, 0), Vec2(0, bad)}) {
            const auto polygon = Polygon::build({{0, 0}, {1, 0}, point, {1, 1}, point});
            ASSERT_FALSE(polygon);
            EXPECT_EQ(polygon.problem().code, ProblemCode::not_finite);
            EXPECT_EQ(polygon.problem().index, 2u);
            EXPECT_NE(polygon.problem().message.find("point 2"), std::string::npos);
        }
}

TEST(Polygon, TakesAnyContiguousPoints) {
    const std::array<Vec2, 3> array{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
    const std::vector<Vec2> vector(array.begin(), array.end());
    const Vec2 c_array[] = {array[0], array[1], array[2]};
    for (const auto& polygon : {Polygon::build(array), Polygon::build(vector), Polygon::build(c_array),
                                Polygon::build(std::span<const Vec2>(vector))})
        EXPECT_EQ(corners(*polygon), vector);
}

TEST(Polygon, IsAValue) {
    Polygon polygon = *Polygon::build({{0, 0}, {2, 0}, {0, 2}});
    const Polygon copy = polygon;
    const Polygon moved = std::move(polygon);
    EXPECT_EQ(corners(copy), corners(moved));
    polygon = Polygon();
    EXPECT_EQ(corners(polygon), std::vector<Vec2>{Vec2(0)});
    EXPECT_EQ(copy.area(), 2);
}

TEST(Polygon, LooksToTheEnginesLikeItsCorners) {
    const Polygon polygon = *Polygon::build({{0, 0}, {4, 0}, {4, 1}, {0, 3}});
    const abut::detail::Convex<2> seen = convex(polygon);
    EXPECT_EQ(seen.core, abut::detail::Core::points);
    EXPECT_EQ(seen.count, 4u);
    EXPECT_EQ(seen.vertices(), polygon.points().data());
    EXPECT_EQ(bounds(seen), (abut::Aabb2{{0, 0}, {4, 3}}));
    EXPECT_EQ(bounds(convex(Polygon())), (abut::Aabb2{{0, 0}, {0, 0}}));
}

TEST(Polygon, IsConvexAndHoldsItsPointsAtEveryScale) {
    for (const double scale : {1e-30, 1e-3, 1.0, 1e4, 1e30})
        for (const double away : {0.0, 1e3}) {
            for (std::uint64_t seed = 0; seed < 50; ++seed) {
                SCOPED_TRACE("scale " + std::to_string(scale) + ", away " + std::to_string(away) + ", seed " +
                             std::to_string(seed));
                abut::oracle::Random random(seed);
                const abut::detail::DVec<2> offset = random.direction<2>() * away;
                std::vector<Vec2> points;
                for (std::uint32_t i = 0, count = 3 + random.below(100); i < count; ++i)
                    points.emplace_back(abut::detail::to_float((random.in_cube<2>() + offset) * scale));
                const Polygon polygon = *Polygon::build(points);
                ASSERT_EQ(polygon.rank(), 2);
                const auto loop = corners(polygon);
                double twice_area = 0;
                abut::detail::DVec<2> weighted(0.0);
                for (std::size_t i = 0; i < loop.size(); ++i) {
                    const abut::detail::DVec<2> a(loop[i]), b(loop[(i + 1) % loop.size()]),
                        c(loop[(i + 2) % loop.size()]);
                    EXPECT_GT(abut::detail::cross(b - a, c - b), 0);
                    for (const Vec2& point : points)
                        ASSERT_GE(abut::detail::cross(b - a, abut::detail::DVec<2>(point) - a), 0) << "a point outside";
                    const abut::detail::DVec<2> from_point = a - abut::detail::DVec<2>(points[0]),
                                                to_point = b - abut::detail::DVec<2>(points[0]);
                    twice_area += abut::detail::cross(from_point, to_point);
                    weighted += abut::detail::cross(from_point, to_point) * (from_point + to_point);
                }
                EXPECT_NEAR(polygon.area(), 0.5 * twice_area, 1e-9 * twice_area);
                const abut::detail::DVec<2> centroid = abut::detail::DVec<2>(points[0]) + weighted / (3 * twice_area);
                EXPECT_LT(length(abut::detail::DVec<2>(polygon.centroid()) - centroid), 1e-7 * (1 + away) * scale);

                std::vector<Vec2> backwards(points.rbegin(), points.rend());
                EXPECT_EQ(corners(*Polygon::build(backwards)), loop);
                EXPECT_EQ(corners(*Polygon::build(loop)), loop);
            }
        }
}

}  // namespace
