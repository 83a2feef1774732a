// Hulls with a vertex limit of ill-conditioned sets: stretched, nearly flat, nearly collinear, tiny, huge or far away.
// They contain every point exactly, and are no larger than the minimum-volume oriented box.

#include "../../oracle/bake/min_volume_box.hpp"
#include "exact_containment.hpp"
#include "ill_conditioned_sets.hpp"
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

double spacing_of_floats(double size) {
    const auto near = static_cast<float>(size);
    return static_cast<double>(std::nextafter(near, std::numeric_limits<float>::infinity())) -
           static_cast<double>(near);
}

/// The side of a box along an axis, grown at both ends by the rounding of its corners to floats.
template <int D>
double rounded_side(double side, const DVec<D>& axis, std::span<const Vec<D>> points) {
    double result = side;
    for (int i = 0; i < D; ++i) {
        double size = 0;
        for (const Vec<D>& point : points) size = std::max(size, std::abs(static_cast<double>(point[i])));
        result += 2 * std::abs(axis[i]) * spacing_of_floats(size);
    }
    return result;
}

/// The allowed volume of a hull with so few corners, as a share of the minimum-volume box.
double share_of_box(std::uint32_t limit) {
    return limit >= 8 ? 1 : limit >= 6 ? 2 : limit == 5 ? 2.25 : 4.5;
}

/// Whether dot(normal, p) <= offset, in rational numbers.
void expect_below_faces(const Hull3& hull, std::span<const Vec3> points) {
    for (std::size_t face = 0; face < hull.normals.size(); ++face)
        for (const Vec3& point : points) {
            const double sum = dot(DVec<3>(hull.normals[face]), DVec<3>(point));
            if (sum < hull.offsets[face] - 1e-14 * std::abs(hull.offsets[face])) continue;
            Rational exact = 0;
            for (int i = 0; i < 3; ++i)
                exact += Rational(static_cast<double>(hull.normals[face][i])) * Rational(static_cast<double>(point[i]));
            ASSERT_LE(exact, Rational(hull.offsets[face]));
        }
}

// Before the search had a frame of its own, 210 of 1043 such hulls were larger than the box, 76 of them four times and
// up to 1e7 times; one of 300 sets crashed.
TEST(IllConditionedHulls, HoldAllAndAreNoLargerThanTheMinVolumeBox) {
    int solids = 0, stretched = 0;
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        const NastySet set = nasty_set(seed);
        SCOPED_TRACE(set.name);
        const Hull3 full = *hull(set.points);
        if (full.rank < 3 || full.points.size() <= 4) continue;
        oracle::OrientedBox box = oracle::min_volume_box(set.points, seed);
        double volume = 1, rounded = 1;
        for (int i = 0; i < 3; ++i) {
            volume *= box.size[i];
            rounded *= rounded_side<3>(box.size[i], box.axes[static_cast<std::size_t>(i)], set.points);
        }
        for (const std::uint32_t limit : {4u, 5u, 6u, 7u, 8u, 12u, 16u, 32u, 64u}) {
            if (full.points.size() <= limit) continue;
            SCOPED_TRACE("limit " + std::to_string(limit));
            const Result<Hull3> found = limited_hull(set.points, {limit});
            ASSERT_TRUE(found);
            ++solids;
            stretched += rounded > 1.01 * volume ? 1 : 0;
            EXPECT_EQ(found->rank, 3);
            EXPECT_LE(found->points.size(), limit);
            EXPECT_EQ(count_outside(found->points, set.points), 0u);
            expect_below_faces(*found, set.points);
            EXPECT_LE(found->volume, share_of_box(limit) * rounded * (1 + 1e-6));
        }
    }
    EXPECT_GT(solids, 250);
    EXPECT_GT(stretched, 30);
}

TEST(IllConditionedHulls, OfThePlaneHoldAllAndAreNoLargerThanTheLeastRectangle) {
    int areas = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const NastySet set = nasty_set(seed);
        SCOPED_TRACE(set.name);
        std::vector<Vec2> points;
        for (const Vec3& point : set.points) points.emplace_back(point.x, seed % 2 == 0 ? point.y : point.z);
        const Hull2 full = *hull(points);
        if (full.rank < 2) continue;
        std::vector<DVec<2>> local;
        for (const Vec2& point : points) local.push_back(DVec<2>(point) - DVec<2>(points[0]));
        const DVec<2> along = oracle::min_area_rectangle_direction(local);
        double rounded = 1;
        for (const DVec<2>& axis : {along, DVec<2>(-along.y, along.x)}) {
            double low = 0, high = 0;
            for (const DVec<2>& p : local) {
                low = std::min(low, dot(axis, p));
                high = std::max(high, dot(axis, p));
            }
            rounded *= rounded_side<2>(high - low, axis, points);
        }
        for (const std::uint32_t limit : {3u, 4u, 5u, 8u, 12u, 24u, 64u}) {
            if (full.points.size() <= limit) continue;
            SCOPED_TRACE("limit " + std::to_string(limit));
            const Result<Polygon> found = Polygon::build(points, {.max_vertices = limit});
            ASSERT_TRUE(found);
            ++areas;
            EXPECT_EQ(found->rank(), 2);
            EXPECT_LE(found->points().size(), limit);
            EXPECT_EQ(count_outside(found->points(), points), 0u);
            EXPECT_LE(found->area(), (limit >= 4 ? 1 : 2) * rounded * (1 + 1e-6));
        }
    }
    EXPECT_GT(areas, 1000);
}

TEST(IllConditionedHulls, OfAPlaneInSpaceAreNoLargerThanTheLeastRectangle) {
    int flat = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const NastySet set = nasty_set(seed);
        SCOPED_TRACE(set.name);
        const Hull3 full = *hull(set.points);
        if (full.rank != 2) continue;
        const DVec<3> normal(full.normals[0]), right = perpendicular(normal), ahead = cross(normal, right);
        std::vector<DVec<2>> seen;
        for (const Vec3& point : set.points) {
            const DVec<3> p = DVec<3>(point) - DVec<3>(set.points[0]);
            seen.emplace_back(dot(right, p), dot(ahead, p));
        }
        const DVec<2> along = oracle::min_area_rectangle_direction(seen);
        double rounded = 2;
        for (const DVec<2>& axis : {along, DVec<2>(-along.y, along.x)}) {
            double low = 0, high = 0;
            for (const DVec<2>& p : seen) {
                low = std::min(low, dot(axis, p));
                high = std::max(high, dot(axis, p));
            }
            // Floats of the projection are up to 1.8 times as far apart in the plane itself.
            const double grown = rounded_side<3>(high - low, right * axis.x + ahead * axis.y, set.points);
            rounded *= high - low + 1.8 * (grown - (high - low));
        }
        for (const std::uint32_t limit : {4u, 5u, 8u, 24u}) {
            if (full.points.size() <= limit) continue;
            SCOPED_TRACE("limit " + std::to_string(limit));
            const Result<Hull3> found = limited_hull(set.points, {limit});
            ASSERT_TRUE(found);
            EXPECT_LE(found->points.size(), limit);
            expect_below_faces(*found, set.points);
            EXPECT_EQ(found->rank, 2);
            ++flat;
            EXPECT_LE(found->area, rounded * (1 + 1e-6));
        }
    }
    EXPECT_GT(flat, 200);
}

// A lattice disc far from the origin, whose plane has few floats: the hull is a solid as thick as the spacing of
// floats.
TEST(IllConditionedHulls, OfAPlaneThatHasFewFloatsAreThick) {
    constexpr float far_away = 1 << 17, step = 0x1p-6f;
    std::vector<Vec3> points;
    for (int i = -12; i <= 12; ++i)
        for (int j = -12; j <= 12; ++j)
            if (i * i + j * j <= 144)
                points.emplace_back(far_away + static_cast<float>(3 * i) * step,
                                    far_away + static_cast<float>(5 * j) * step,
                                    far_away + static_cast<float>(i + j) * step);
    EXPECT_EQ(hull(points)->rank, 2);
    for (const std::uint32_t limit : {4u, 5u, 6u, 8u, 12u}) {
        SCOPED_TRACE("limit " + std::to_string(limit));
        const Result<Hull3> found = limited_hull(points, {limit});
        ASSERT_TRUE(found);
        EXPECT_EQ(found->rank, 3);
        EXPECT_LE(found->points.size(), limit);
        EXPECT_EQ(count_outside(found->points, points), 0u);
        expect_below_faces(*found, points);
        const double size = 72 * static_cast<double>(step);
        EXPECT_LT(found->volume, share_of_box(limit) * 2 * size * size * 6 * static_cast<double>(step));
    }
}

// Thirteen nearly coplanar points: the faces of their hull shared a diagonal, and the search for 8 corners read beyond
// the end of its triangles.
TEST(IllConditionedHulls, OfThirteenPointsNearlyInAPlaneIsOneOfEightCorners) {
    const std::vector<Vec3> points{
        {0x1.d5555cp-2f, -0x1.1aba04p-2f, 0x1.d3p-24f},   {-0x1.fd29eep-2f, 0x1.edd6bap-2f, 0x1.878p-23f},
        {0x1.f8ecb2p-2f, 0x1.568264p-2f, 0x1.218p-23f},   {0x1.df5c3cp-2f, -0x1.48df36p-3f, 0x1.9p-24f},
        {-0x1.f66576p-2f, -0x1.d0aa46p-2f, 0x1.6c8p-23f}, {0x1.7ec9e2p-3f, -0x1.ffa3aap-2f, 0x1.d1p-24f},
        {0x1.e948dcp-2f, 0x1.9037e4p-5f, 0x1.78p-24f},    {0x1.a8864ap-2f, 0x1.fdf01ep-2f, 0x1.568p-23f},
        {0x1.b71d46p-2f, -0x1.6efeb6p-2f, 0x1.fep-24f},   {-0x1.babd28p-5f, -0x1.ec727cp-2f, 0x1.7ep-24f},
        {-0x1.e0f31ep-4f, 0x1.31be4ep-4f, 0x1.fp-28f},    {-0x1.c4e74cp-3f, -0x1.ec8c8p-2f, 0x1.c9p-24f},
        {0x1.b3442cp-2f, 0x1.f947cap-2f, 0x1.5ap-23f}};
    for (const std::uint32_t limit : {4u, 5u, 6u, 8u}) {
        const Result<Polyhedron> found = Polyhedron::build(points, {.max_vertices = limit});
        ASSERT_TRUE(found);
        EXPECT_LE(found->points().size(), limit);
        EXPECT_EQ(count_outside(found->points(), points), 0u);
    }
}

/// A shallow bowl: two rings of points at this distance.
std::vector<Vec3> dish(double depth, double thickness) {
    constexpr int rings = 6, sides = 24;
    std::vector<Vec3> result;
    for (const double up : {0.0, thickness})
        for (int i = 0; i <= rings; ++i)
            for (int j = 0; j < sides; ++j) {
                const double angle = 2 * 3.14159265358979323846 * j / sides, out = static_cast<double>(i) / rings;
                result.push_back(
                    to_float(DVec<3>(out * std::cos(angle), out * std::sin(angle), depth * out * out + up)));
            }
    return result;
}

// At its bottom, floats are closer together than the rounding of doubles in the frame: rounding a vertex there found no
// float, and 100 vertices added 69 % where these add half a percent.
TEST(IllConditionedHulls, OfDishesAddLittle) {
    for (const double depth : {0.02, 0.2, 0.6})
        for (const double thickness : {0.0, 4e-6, 1e-4, 1e-3}) {
            SCOPED_TRACE("depth " + std::to_string(depth) + ", thickness " + std::to_string(thickness));
            const std::vector<Vec3> points = dish(depth, thickness);
            const double volume = hull(points)->volume;
            for (const auto& [limit, most] : {std::pair(8u, 0.45), std::pair(16u, 0.25), std::pair(32u, 0.1),
                                              std::pair(64u, 0.045), std::pair(100u, 0.02)}) {
                SCOPED_TRACE("limit " + std::to_string(limit));
                double added = 0;
                ASSERT_TRUE(limited_hull(points, {limit, &added}));
                EXPECT_LT(added, most * volume);
            }
        }
}

}  // namespace
}  // namespace abut::test
