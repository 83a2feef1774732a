// Hulls in 2D: the filtered hull has the corners of a monotone chain over all points, and hulls with a vertex limit
// contain all points.

#include "exact_containment.hpp"
#include "point_sets.hpp"
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/math/predicates.hpp>
#include <abut/shape/polygon.hpp>

#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

/// The monotone chain of Andrew (1979), without a filter.
std::vector<std::uint32_t> monotone_chain(const std::vector<Vec2>& points) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        return points[i] == points[j] ? i < j : less(points[i], points[j]);
    });
    const auto same = [&](std::uint32_t i, std::uint32_t j) { return points[i] == points[j]; };
    order.erase(std::unique(order.begin(), order.end(), same), order.end());
    if (order.size() == 1) return order;
    std::vector<std::uint32_t> loop;
    for (int chain = 0; chain < 2; ++chain) {
        const std::size_t first = loop.size();
        for (const std::uint32_t i : order) {
            while (loop.size() >= first + 2 &&
                   orientation(points[loop[loop.size() - 2]], points[loop.back()], points[i]) <= 0)
                loop.pop_back();
            loop.push_back(i);
        }
        loop.pop_back();
        std::reverse(order.begin(), order.end());
    }
    return loop;
}

struct PlaneKind {
    std::string name;
    std::function<Vec2(Random&)> make;
};
const std::vector<PlaneKind> plane_kinds{
    {"square", [](Random& random) { return to_float(random.in_cube<2>()); }},
    {"disc", [](Random& random) { return to_float(random.direction<2>() * std::sqrt(random.unit())); }},
    {"circle", [](Random& random) { return to_float(random.direction<2>()); }},
    {"coarse grid",
     [](Random& random) {
         const auto x = static_cast<float>(random.below(20));
         return Vec2(x, static_cast<float>(random.below(20)));
     }},
    {"column", [](Random& random) { return Vec2(0.5f, static_cast<float>(random.below(50))); }},
    {"diagonal",
     [](Random& random) {
         const auto x = static_cast<float>(random.below(1000));
         return Vec2(x, 3 * x);
     }},
    {"nearly a diagonal",
     [](Random& random) {
         const float x = random.uniform_float(-1, 1);
         return Vec2(x, x * (1 + 1e-7f * static_cast<float>(random.below(3))));
     }},
    {"zeros of both signs",
     [](Random& random) {
         const float zero = random.chance(0.5) ? 0.0f : -0.0f;
         return Vec2(zero, static_cast<float>(random.below(5)) - 2);
     }},
    {"all exponents",
     [](Random& random) {
         const DVec<2> direction = random.direction<2>();
         return to_float(direction * random.power_of_two(-148, 127));
     }},
    {"one place", [](Random&) { return Vec2(3, -4); }},
};

std::vector<Vec2> plane_points(const PlaneKind& kind, Random& random, int count) {
    std::vector<Vec2> result;
    for (int i = 0; i < count; ++i) result.push_back(kind.make(random));
    return result;
}

TEST(HullLoop, EqualsTheMonotoneChainIndexByIndex) {
    std::size_t corners = 0;
    for (const PlaneKind& kind : plane_kinds)
        for (const int count : {1, 2, 3, 10, 63, 64, 65, 500, 2000, 2100, 20000})
            for (std::uint64_t seed = 0; seed < (count < 100 ? 20u : 3u); ++seed) {
                SCOPED_TRACE(kind.name + ", " + std::to_string(count) + " points, seed " + std::to_string(seed));
                Random random(seed);
                const std::vector<Vec2> points = plane_points(kind, random, count);
                const std::vector<std::uint32_t> loop = hull_loop(points);
                ASSERT_EQ(loop, monotone_chain(points));
                corners += loop.size();
            }
    EXPECT_GT(corners, 20000u);
}

double area_of(std::span<const Vec2> loop) {
    double twice = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        twice += cross(DVec<2>(loop[i]) - DVec<2>(loop[0]), DVec<2>(loop[(i + 1) % loop.size()]) - DVec<2>(loop[0]));
    return twice / 2;
}

TEST(LimitedHullOfThePlane, HoldsEveryPointExactly) {
    int limited = 0;
    for (const PlaneKind& kind : plane_kinds)
        for (const double scale : {1e-3, 1.0, 1e4})
            for (const double away : {0.0, 1e5})
                for (const std::uint32_t limit : {3u, 4u, 5u, 9u, 16u}) {
                    if (kind.name == "all exponents" && scale * away != 0) continue;
                    const std::uint64_t seed = limit;
                    SCOPED_TRACE(kind.name + ", scale " + std::to_string(scale) + ", away " + std::to_string(away) +
                                 ", limit " + std::to_string(limit) + ", seed " + std::to_string(seed));
                    Random random(seed);
                    std::vector<Vec2> points = plane_points(kind, random, 200);
                    const DVec<2> offset = random.direction<2>() * away;
                    const double factor = kind.name == "all exponents" ? 1e-4 : scale;
                    for (Vec2& point : points) point = to_float(DVec<2>(point) * factor + offset);
                    const Hull2 full = *hull(points);
                    double added = -1;
                    const auto built = limited_hull(points, {limit, &added});
                    ASSERT_TRUE(built);
                    ASSERT_LE(built->points.size(), limit);
                    EXPECT_EQ(built->rank, full.rank);
                    if (full.points.size() <= limit) {
                        EXPECT_EQ(built->points, full.points);
                        EXPECT_EQ(added, 0);
                        continue;
                    }
                    ++limited;
                    EXPECT_EQ(count_outside(built->points, points), 0u);
                    EXPECT_NEAR(added, area_of(built->points) - area_of(full.points), 1e-9 * area_of(built->points));
                    EXPECT_GE(added, 0);
                    std::reverse(points.begin(), points.end());
                    EXPECT_EQ(limited_hull(points, {limit})->points, built->points);
                }
    EXPECT_GT(limited, 90);
}

TEST(LimitedHullOfThePlane, ReportsProblems) {
    std::vector<Vec2> square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    EXPECT_EQ(limited_hull(square, {2}).problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(limited_hull(square, {1}).problem().code, ProblemCode::bad_argument);
    EXPECT_FALSE(Polygon::build(square, {.max_vertices = 2}));
    EXPECT_EQ(limited_hull(square, {3})->points.size(), 3u);
    EXPECT_EQ(limited_hull(std::vector<Vec2>(), {3}).problem().code, ProblemCode::empty_input);
    for (Vec2& point : square) point *= std::numeric_limits<float>::max();
    EXPECT_EQ(limited_hull(square, {4})->points.size(), 4u);
    EXPECT_EQ(limited_hull(square, {3}).problem().code, ProblemCode::too_large);
}

// Two of the corners are within 1e-20 of an edge, relative to its length: the triangle around all five had become a
// line.
TEST(LimitedHullOfThePlane, HoldsCornersNearlyInALine) {
    const std::vector<Vec2> points{
        {-3.6e13f, 4.4e-19f}, {1.7e14f, -4.6e33f}, {4.1e34f, -2.1e11f}, {3.8e32f, 1.3e-26f}, {1.5e24f, 1.2e-15f}};
    EXPECT_EQ(hull(points)->points.size(), 5u);
    for (const std::uint32_t limit : {3u, 4u}) {
        SCOPED_TRACE("limit " + std::to_string(limit));
        double added = -1;
        const auto built = limited_hull(points, {limit, &added});
        ASSERT_TRUE(built);
        EXPECT_EQ(count_outside(built->points, points), 0u);
        EXPECT_LT(added, 1e-3 * area_of(built->points));
    }
}

// The best polygon around a circle is regular: n tan(pi / n) / pi times its area.
TEST(LimitedHullOfThePlane, IsNearlyTheBestAroundACircle) {
    constexpr double pi = 3.14159265358979323846;
    std::vector<Vec2> circle;
    for (int i = 0; i < 1000; ++i)
        circle.emplace_back(static_cast<float>(std::cos(2 * pi * i / 1000)),
                            static_cast<float>(std::sin(2 * pi * i / 1000)));
    for (const std::uint32_t limit : {3u, 4u, 5u, 8u, 12u, 20u, 50u}) {
        SCOPED_TRACE("limit " + std::to_string(limit));
        double added = 0;
        const Hull2 found = *limited_hull(circle, {limit, &added});
        EXPECT_EQ(found.points.size(), limit);
        const double best = limit * std::tan(pi / limit) - pi;
        EXPECT_LT(added, 1.03 * best);
        EXPECT_GT(added, 0.99 * best);
    }
    EXPECT_NEAR(Polygon::build(circle, {.max_vertices = 4})->area(), 4, 0.001);
}

/// The least area of a polygon around a loop whose lines all contain edges of it, by brute force.
double best_along_edges(const std::vector<Vec2>& loop, std::uint32_t limit) {
    const std::size_t count = loop.size();
    double least = std::numeric_limits<double>::max();
    for (std::uint32_t choice = 0; choice < 1u << count; ++choice) {
        std::vector<std::size_t> edges;
        for (std::size_t i = 0; i < count; ++i)
            if ((choice >> i & 1u) != 0) edges.push_back(i);
        if (edges.size() != limit) continue;
        std::vector<DVec<2>> corners;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const std::size_t a = edges[i], b = edges[(i + 1) % edges.size()];
            const DVec<2> from(loop[a]), u = DVec<2>(loop[(a + 1) % count]) - from;
            const DVec<2> to(loop[b]), v = DVec<2>(loop[(b + 1) % count]) - to;
            if (!(cross(u, v) > 1e-9)) break;
            corners.push_back(from + u * (cross(to - from, v) / cross(u, v)));
        }
        if (corners.size() < edges.size()) continue;
        double twice = 0;
        for (std::size_t i = 0; i < corners.size(); ++i)
            twice += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
        least = std::min(least, twice / 2);
    }
    return least;
}

TEST(LimitedHullOfThePlane, IsAsGoodAsTheBestOfAllEdges) {
    int better = 0, all = 0;
    double most = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const std::vector<Vec2> points = plane_points(plane_kinds[1], random, 18);
        const Hull2 full = *hull(points);
        const std::uint32_t limit = 3 + random.below(4);
        if (full.points.size() <= limit || full.points.size() > 11) continue;
        double added = 0;
        const Hull2 found = *limited_hull(points, {limit, &added});
        const double best = best_along_edges(full.points, limit);
        ++all;
        better += area_of(found.points) < best * (1 - 1e-6) ? 1 : 0;
        most = std::max(most, area_of(found.points) / best);
    }
    EXPECT_GT(all, 200);
    EXPECT_GT(better, all / 20);
    EXPECT_LT(most, 1.15);
}

}  // namespace
}  // namespace abut::test
