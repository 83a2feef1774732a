// Hulls with a vertex limit in 3D: they contain all points, and add little volume.

#include "exact_containment.hpp"
#include "point_sets.hpp"
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/limited/inner_hull.hpp>
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/shape/polyhedron.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

struct Limited {
    Hull3 full, hull;
    double added = -1;

    double share() const { return added / full.volume; }
};

Limited limited(const std::vector<Vec3>& points, std::uint32_t limit) {
    Limited result{*abut::detail::hull(points), {}};
    const auto built = limited_hull(points, {limit, &result.added});
    EXPECT_TRUE(built) << built.problem().message;
    if (built) result.hull = *built;
    return result;
}

void expect_same(const Hull3& a, const Hull3& b) {
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.offsets, b.offsets);
    EXPECT_EQ(a.loops, b.loops);
    EXPECT_EQ(a.loop_ends, b.loop_ends);
    EXPECT_EQ(a.volume, b.volume);
    EXPECT_EQ(a.area, b.area);
}

/// The projection of a flat set along the axis nearest to its normal.
std::vector<Vec2> shadow(const std::vector<Vec3>& points, const Vec3& normal) {
    const DVec<3> n(normal), steep{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    const int up = steep.x >= steep.y && steep.x >= steep.z ? 0 : (steep.y >= steep.z ? 1 : 2);
    std::vector<Vec2> result;
    for (const Vec3& point : points) result.emplace_back(point[(up + 1) % 3], point[(up + 2) % 3]);
    return result;
}

void expect_holds(const Hull3& hull, const std::vector<Vec3>& points) {
    const double side = extent<3>(hull.points);
    for (std::size_t face = 0; face < hull.normals.size(); ++face)
        for (const Vec3& point : points)
            ASSERT_LE(dot(DVec<3>(hull.normals[face]), DVec<3>(point)), hull.offsets[face] + 2e-7 * side);
    if (hull.rank == 3) {
        EXPECT_EQ(count_outside(hull.points, points), 0u);
    } else {
        EXPECT_EQ(count_outside(shadow(hull.points, hull.normals[0]), shadow(points, hull.normals[0])), 0u);
    }
}

/// A box without its corners.
std::vector<Vec3> bevelled_box() {
    std::vector<Vec3> result;
    for (const Vec3& corner : box_surface(1))
        for (int i = 0; i < 3; ++i) {
            Vec3 point = corner;
            point[i] *= 0.9f;
            result.push_back(point);
        }
    return result;
}

TEST(LimitedHull, OfFewerCornersIsTheHullBitByBit) {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        SCOPED_TRACE(kinds[kind].name + ", seed " + std::to_string(kind));
        Random random(kind);
        const std::vector<Vec3> points = kinds[kind].make(random);
        const Hull3 full = *hull(points);
        const auto count = static_cast<std::uint32_t>(full.points.size());
        for (const std::uint32_t limit : {0u, std::max(count, 4u), count + 1000}) {
            double added = -1;
            expect_same(full, *limited_hull(points, {limit, &added}));
            EXPECT_EQ(added, 0);
            EXPECT_FALSE(std::signbit(added));
        }
    }
}

TEST(LimitedHull, ReportsProblems) {
    const std::vector<Vec3> points = box_surface(1);
    for (const std::uint32_t limit : {1u, 2u, 3u}) {
        const auto built = limited_hull(points, {limit});
        ASSERT_FALSE(built);
        EXPECT_EQ(built.problem().code, ProblemCode::bad_argument);
        EXPECT_FALSE(Polyhedron::build(points, {.max_vertices = limit}));
    }
    const std::vector<Vec3> none, broken{Vec3(0.0f), Vec3(1, std::numeric_limits<float>::quiet_NaN(), 2)};
    EXPECT_EQ(limited_hull(none, {8}).problem().code, ProblemCode::empty_input);
    EXPECT_EQ(limited_hull(broken, {8}).problem().code, ProblemCode::not_finite);
    EXPECT_EQ(limited_hull(broken, {8}).problem().index, 1u);

    // The hull of a box at the limits of float has eight corners.
    std::vector<Vec3> largest = points;
    for (Vec3& point : largest) point *= std::numeric_limits<float>::max();
    EXPECT_TRUE(limited_hull(largest, {8}));
    ASSERT_FALSE(limited_hull(largest, {7}));
    EXPECT_EQ(limited_hull(largest, {7}).problem().code, ProblemCode::too_large);
}

TEST(LimitedHull, HoldsEveryPointExactly) {
    std::map<int, int> ranks;
    int at_the_limit = 0, all = 0;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (const double scale : {1e-3, 1.0, 1e4})
            for (const double away : {0.0, 1e5})
                for (const std::uint32_t limit : {4u, 5u, 6u, 8u, 13u, 24u}) {
                    const std::uint64_t seed = 100 * kind + limit;
                    SCOPED_TRACE(kinds[kind].name + ", scale " + std::to_string(scale) + ", away " +
                                 std::to_string(away) + ", limit " + std::to_string(limit) + ", seed " +
                                 std::to_string(seed));
                    Random random(seed);
                    std::vector<Vec3> points = kinds[kind].make(random);
                    const DVec<3> offset = random.direction<3>() * away;
                    for (Vec3& point : points) point = to_float(DVec<3>(point) * scale + offset);
                    const Limited result = limited(points, limit);
                    if (result.full.points.size() <= limit) continue;
                    ASSERT_FALSE(result.hull.points.empty());
                    ++ranks[result.hull.rank];
                    ++all;
                    at_the_limit += result.hull.points.size() == limit ? 1 : 0;
                    EXPECT_LE(result.hull.points.size(), limit);
                    EXPECT_GE(result.hull.rank, result.full.rank);
                    for (const Vec3& point : result.hull.points) ASSERT_TRUE(is_finite(point));
                    expect_holds(result.hull, points);
                    const double more = result.full.rank == 2 ? result.hull.area - result.full.area
                                                              : result.hull.volume - result.full.volume;
                    EXPECT_EQ(result.added, std::max(0.0, more));
                }
    EXPECT_GT(ranks[3], 280);
    EXPECT_GT(at_the_limit, all / 2);
}

TEST(LimitedHull, DoesNotDependOnTheOrderOfThePoints) {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        SCOPED_TRACE(kinds[kind].name + ", seed " + std::to_string(kind));
        Random random(kind);
        std::vector<Vec3> points = kinds[kind].make(random);
        const Hull3 first = *limited_hull(points, {9});
        std::reverse(points.begin(), points.end());
        points.push_back(points[0]);
        expect_same(first, *limited_hull(points, {9}));
    }
}

// The volume added by a simple alternative: the hull of inner corners, scaled up until it contains all points.
double share_of_scaled(const Limited& limited, std::size_t limit) {
    const Hull3 inner = inner_hull(limited.full.points, limit, limited.full.points[0]);
    const DVec<3> middle(inner.centroid);
    double factor = 1;
    for (std::size_t face = 0; face < inner.normals.size(); ++face) {
        const DVec<3> normal(inner.normals[face]);
        for (const Vec3& point : limited.full.points)
            factor =
                std::max(factor, dot(normal, DVec<3>(point) - middle) / (inner.offsets[face] - dot(normal, middle)));
    }
    return inner.volume * factor * factor * factor / limited.full.volume - 1;
}

TEST(LimitedHull, AddsLittle) {
    Random random(77);
    const std::vector<Vec3> ball = on_a_sphere(random, 2000), flattened = stretched(ball, {1, 3, 0.01f});
    struct Case {
        std::uint32_t limit;
        double most;
    };
    // Optimal: 0.65 for 6 corners, 0.21 for 12, a bit above 0.06 for 32.
    for (const auto& [limit, most] : {Case{6, 0.75}, Case{12, 0.35}, Case{32, 0.115}, Case{64, 0.06}}) {
        SCOPED_TRACE("limit " + std::to_string(limit));
        const Limited round = limited(ball, limit), flat = limited(flattened, limit);
        EXPECT_LT(round.share(), most);
        EXPECT_LT(flat.share(), 1.1 * most);
        EXPECT_GT(round.share(), 0);
        EXPECT_LT(round.share(), 0.9 * share_of_scaled(round, limit));
    }
    // The optimum around a cylinder of many sides is a prism: n tan(pi / n) / pi - 1 more.
    const std::vector<Vec3> cylinder = turned(rings(256), random);
    for (const auto& [limit, most] : {Case{8, 0.275}, Case{12, 0.108}, Case{16, 0.065}}) {
        SCOPED_TRACE("cylinder, limit " + std::to_string(limit));
        EXPECT_LT(limited(cylinder, limit).share(), most + 0.02);
    }
    // A box with its corners cut off becomes a box again, in any orientation.
    const Limited box = limited(turned(bevelled_box(), random), 8);
    EXPECT_EQ(box.full.points.size(), 24u);
    EXPECT_EQ(box.hull.points.size(), 8u);
    EXPECT_EQ(box.hull.loop_ends.size(), 6u);
    EXPECT_LT(box.share(), 3e-4);
}

TEST(LimitedHull, OfWhatIsFlatIsFlat) {
    Random random(78);
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<Vec3> points = on_a_sphere(random, 100);
        for (Vec3& point : points) point[axis] = 0.3f;
        const Limited result = limited(points, 7);
        EXPECT_EQ(result.hull.rank, 2);
        EXPECT_EQ(result.hull.points.size(), 7u);
        for (const Vec3& point : result.hull.points) EXPECT_EQ(point[axis], 0.3f);
        expect_holds(result.hull, points);
        EXPECT_GT(result.added, 0);
        EXPECT_EQ(result.added, result.hull.area - result.full.area);
        EXPECT_LT(result.added, 0.25 * result.full.area);
    }
    const std::vector<Vec3> tilted = turned(stretched(on_a_sphere(random, 100), {1, 1, 0}), random);
    const Limited result = limited(tilted, 5);
    EXPECT_EQ(result.full.rank, 2);
    EXPECT_EQ(result.hull.rank, 2);
    EXPECT_EQ(result.hull.points.size(), 5u);
    expect_holds(result.hull, tilted);
    // A set without a plane has no limited hull in the plane.
    EXPECT_EQ(limited({Vec3(0.0f), Vec3(1.0f), Vec3(2.0f)}, 4).hull.rank, 1);
    EXPECT_EQ(limited({Vec3(2.0f)}, 4).hull.rank, 0);
}

TEST(LimitedHull, OfManyPoints) {
    Random random(79);
    const std::vector<Vec3> points = on_a_sphere(random, 20000);
    const Limited result = limited(points, 32);
    EXPECT_LE(result.hull.points.size(), 32u);
    EXPECT_LT(result.share(), 0.115);
    expect_holds(result.hull, points);
}

TEST(LimitedPolyhedron, IsMadeOfTheLimitedHull) {
    Random random(80);
    const std::vector<Vec3> points = on_a_sphere(random, 200);
    double added = -1;
    const auto polyhedron = Polyhedron::build(points, {.max_vertices = 20, .added = &added});
    ASSERT_TRUE(polyhedron);
    const Hull3 hull = *limited_hull(points, {20});
    EXPECT_TRUE(std::equal(hull.points.begin(), hull.points.end(), polyhedron->points().begin()));
    EXPECT_EQ(polyhedron->points().size(), 20u);
    EXPECT_EQ(added, polyhedron->volume() - Polyhedron::build(points)->volume());
}

}  // namespace
}  // namespace abut::test
