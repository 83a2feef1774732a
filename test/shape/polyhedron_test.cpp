#include "../oracle/random.hpp"
#include <abut/math/dvec.hpp>
#include <abut/shape/polyhedron.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace {

using abut::Polyhedron;
using abut::ProblemCode;
using abut::Vec3;
using abut::detail::DVec;
using abut::detail::Facets;

using Loop = std::vector<std::uint32_t>;

std::vector<Vec3> corners(const Polyhedron& polyhedron) {
    return {polyhedron.points().begin(), polyhedron.points().end()};
}

std::vector<Loop> loops(const Polyhedron& polyhedron) {
    std::vector<Loop> result;
    const Facets& facets = polyhedron.facets();
    std::uint32_t begin = 0;
    for (const std::uint32_t end : facets.loop_ends) {
        result.emplace_back(facets.loops.begin() + begin, facets.loops.begin() + end);
        begin = end;
    }
    return result;
}

std::vector<Vec3> cube_grid(int pieces, float side) {
    std::vector<Vec3> result;
    const auto at = [&](int i) { return side * static_cast<float>(i) / static_cast<float>(pieces); };
    for (int x = 0; x <= pieces; ++x)
        for (int y = 0; y <= pieces; ++y)
            for (int z = 0; z <= pieces; ++z) result.emplace_back(at(x), at(y), at(z));
    return result;
}

TEST(Polyhedron, IsTheOriginUnlessBuilt) {
    const Polyhedron polyhedron;
    EXPECT_EQ(corners(polyhedron), std::vector<Vec3>{Vec3(0)});
    EXPECT_EQ(polyhedron.rank(), 0);
    EXPECT_EQ(polyhedron.volume(), 0);
    EXPECT_EQ(polyhedron.area(), 0);
    EXPECT_EQ(polyhedron.centroid(), Vec3(0));
    EXPECT_TRUE(polyhedron.facets().normals.empty());
    EXPECT_TRUE(polyhedron.offsets().empty());
}

TEST(Polyhedron, OfATetrahedron) {
    const auto built = Polyhedron::build({{0, 0, 3}, {0, 3, 0}, {0, 0, 0}, {3, 0, 0}});
    ASSERT_TRUE(built);
    EXPECT_EQ(corners(*built), (std::vector<Vec3>{{0, 0, 0}, {0, 0, 3}, {0, 3, 0}, {3, 0, 0}}));
    EXPECT_EQ(built->rank(), 3);
    EXPECT_EQ(loops(*built), (std::vector<Loop>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}));
    const auto normals = built->facets().normals;
    EXPECT_EQ(normals[0], Vec3(-1, 0, 0));
    EXPECT_EQ(normals[1], Vec3(0, 0, -1));
    EXPECT_EQ(normals[2], Vec3(0, -1, 0));
    EXPECT_NEAR(normals[3].x, 0.57735027, 1e-7);
    EXPECT_EQ(built->offsets()[0], 0);
    EXPECT_NEAR(built->offsets()[3], 1.7320508, 1e-6);
    EXPECT_DOUBLE_EQ(built->volume(), 4.5);
    EXPECT_NEAR(built->area(), 3 * 4.5 + 7.79422863, 1e-7);
    EXPECT_EQ(built->centroid(), Vec3(0.75f));
}

TEST(Polyhedron, OfAGridOfPointsIsItsCube) {
    for (const int pieces : {1, 2, 10})
        for (const float side : {1e-6f, 1.0f, 1e6f}) {
            SCOPED_TRACE(std::to_string(pieces) + " pieces, side " + std::to_string(side));
            const auto built = Polyhedron::build(cube_grid(pieces, side));
            EXPECT_EQ(corners(*built), cube_grid(1, side));
            ASSERT_EQ(built->facets().normals.size(), 6u);
            for (const Loop& loop : loops(*built)) EXPECT_EQ(loop.size(), 4u);
            for (const Vec3& normal : built->facets().normals)
                EXPECT_EQ(std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z), 1);
            for (const double offset : built->offsets())
                EXPECT_TRUE(offset == 0 || offset == static_cast<double>(side));
            const double length = static_cast<double>(side);
            EXPECT_NEAR(built->volume(), length * length * length, 1e-7 * length * length * length);
            EXPECT_NEAR(built->area(), 6 * length * length, 1e-7 * length * length);
            EXPECT_NEAR(built->centroid().y / side, 0.5, 1e-6);
        }
}

TEST(Polyhedron, OfACylinderOf64Sides) {
    std::vector<Vec3> points;
    for (int i = 0; i < 64; ++i) {
        const double angle = 2 * 3.14159265358979323846 * i / 64;
        for (const float z : {-2.0f, 2.0f})
            points.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), z);
    }
    const auto built = Polyhedron::build(points);
    EXPECT_EQ(built->points().size(), 128u);
    int caps = 0, sides = 0;
    for (const Loop& loop : loops(*built)) {
        caps += loop.size() == 64 ? 1 : 0;
        sides += loop.size() == 4 ? 1 : 0;
    }
    EXPECT_EQ(caps, 2);
    EXPECT_EQ(sides, 64);
    EXPECT_EQ(built->facets().normals.size(), 66u);
    EXPECT_NEAR(built->volume(), 4 * 32 * std::sin(2 * 3.14159265358979323846 / 64), 1e-5);
}

TEST(Polyhedron, OfAFlatSquareHasTwoSides) {
    std::vector<Vec3> points;
    for (int x = 0; x <= 4; ++x)
        for (int y = 0; y <= 4; ++y) points.emplace_back(static_cast<float>(x), static_cast<float>(y), 7.0f);
    const auto built = Polyhedron::build(points);
    EXPECT_EQ(corners(*built), (std::vector<Vec3>{{0, 0, 7}, {0, 4, 7}, {4, 0, 7}, {4, 4, 7}}));
    EXPECT_EQ(built->rank(), 2);
    EXPECT_EQ(loops(*built), (std::vector<Loop>{{0, 1, 3, 2}, {0, 2, 3, 1}}));
    EXPECT_EQ(built->facets().normals[0], Vec3(0, 0, -1));
    EXPECT_EQ(built->facets().normals[1], Vec3(0, 0, 1));
    EXPECT_EQ(built->offsets()[0], -7);
    EXPECT_EQ(built->offsets()[1], 7);
    EXPECT_EQ(built->volume(), 0);
    EXPECT_DOUBLE_EQ(built->area(), 32);
    EXPECT_EQ(built->centroid(), Vec3(2, 2, 7));
}

TEST(Polyhedron, OfATriangleSeenAlongEachAxisIsFlat) {
    for (int up = 0; up < 3; ++up) {
        std::vector<Vec3> points(3, Vec3(0));
        points[1][(up + 1) % 3] = 2;
        points[2][(up + 2) % 3] = 2;
        points[0][up] = points[1][up] = points[2][up] = -1;
        const auto built = Polyhedron::build(points);
        EXPECT_EQ(built->rank(), 2);
        EXPECT_EQ(built->points().size(), 3u);
        EXPECT_DOUBLE_EQ(built->area(), 4);
        ASSERT_EQ(built->facets().normals.size(), 2u);
        EXPECT_EQ(std::abs(built->facets().normals[0][up]), 1);
        EXPECT_EQ(built->facets().normals[0], -built->facets().normals[1]);
    }
}

TEST(Polyhedron, OfPointsOnALineIsASegment) {
    const auto built = Polyhedron::build({{1, 2, 3}, {5, 10, 15}, {3, 6, 9}, {-1, -2, -3}, {3, 6, 9}});
    EXPECT_EQ(corners(*built), (std::vector<Vec3>{{-1, -2, -3}, {5, 10, 15}}));
    EXPECT_EQ(built->rank(), 1);
    EXPECT_TRUE(built->facets().normals.empty());
    EXPECT_EQ(built->area(), 0);
    EXPECT_EQ(built->centroid(), Vec3(2, 4, 6));
}

// Along y the lexicographically least point may be any: the ends are those that are farthest apart.
TEST(Polyhedron, OfANoisyLineReachesItsEnds) {
    const auto built = Polyhedron::build({{-1e-8f, 0.5f, 0}, {0, 0, 0}, {0, 1, 1e-8f}, {1e-8f, 0.25f, 0}});
    EXPECT_EQ(corners(*built), (std::vector<Vec3>{{0, 0, 0}, {0, 1, 1e-8f}}));
}

TEST(Polyhedron, OfOnePointManyTimes) {
    const auto built = Polyhedron::build({{3, -4, 5}, {3, -4, 5}});
    EXPECT_EQ(corners(*built), (std::vector<Vec3>{{3, -4, 5}}));
    EXPECT_EQ(built->rank(), 0);
    EXPECT_EQ(built->centroid(), Vec3(3, -4, 5));
}

TEST(Polyhedron, IsFlatUpTo1e7OfItsExtent) {
    for (const float scale : {1e-30f, 1e-6f, 1.0f, 1e6f, 1e30f}) {
        SCOPED_TRACE(scale);
        const auto plate = [&](float thickness) {
            return Polyhedron::build({Vec3(0) * scale, Vec3(1, 0, 0) * scale, Vec3(1, 1, 0) * scale,
                                      Vec3(0, 1, 0) * scale, Vec3(0.5f, 0.5f, thickness) * scale})
                ->rank();
        };
        EXPECT_EQ(plate(0), 2);
        EXPECT_EQ(plate(0.9e-7f), 2);
        EXPECT_EQ(plate(1.3e-7f), 3);
        EXPECT_EQ(plate(-1e-3f), 3);
    }
}

TEST(Polyhedron, OfNothingIsAProblem) {
    for (const auto& built : {Polyhedron::build({}), Polyhedron::build(std::vector<Vec3>())}) {
        ASSERT_FALSE(built);
        EXPECT_EQ(built.problem().code, ProblemCode::empty_input);
        EXPECT_FALSE(built.problem().message.empty());
    }
}

TEST(Polyhedron, NamesThePointThatIsNotFinite) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()})
        for (int i = 0; i < 3; ++i) {
            std::vector<Vec3> points = cube_grid(1, 1);
            points[5][i] = points[7][i] = bad;
            const auto built = Polyhedron::build(points);
            ASSERT_FALSE(built);
            EXPECT_EQ(built.problem().code, ProblemCode::not_finite);
            EXPECT_EQ(built.problem().index, 5u);
            EXPECT_NE(built.problem().message.find("point 5"), std::string::npos);
        }
}

TEST(Polyhedron, TakesAnyFiniteFloats) {
    constexpr float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    for (const float size : {most, least}) {
        SCOPED_TRACE(size);
        const auto built = Polyhedron::build({{-size, -size, -size}, {size, 0, 0}, {0, size, 0}, {0, 0, size}});
        ASSERT_TRUE(built);
        EXPECT_EQ(built->rank(), 3);
        EXPECT_EQ(built->facets().normals.size(), 4u);
        EXPECT_GT(built->volume(), 0);
        EXPECT_TRUE(std::isfinite(built->volume()));
        EXPECT_TRUE(abut::detail::is_finite<3>(built->centroid()));
        for (const Vec3& normal : built->facets().normals) EXPECT_NEAR(length(abut::detail::DVec<3>(normal)), 1, 1e-6);
    }
}

TEST(Polyhedron, SharesWhatWasBuiltWithItsCopies) {
    Polyhedron last;
    const Facets* facets = nullptr;
    const Vec3* points = nullptr;
    {
        Polyhedron first = *Polyhedron::build(cube_grid(1, 2));
        facets = &first.facets();
        points = first.points().data();
        Polyhedron copy = first;
        last = std::move(first);
        EXPECT_EQ(first.rank(), 0);  // NOLINT: what a moved-from polyhedron is, is promised
        EXPECT_EQ(corners(first), std::vector<Vec3>{Vec3(0)});
        EXPECT_EQ(&copy.facets(), facets);
    }
    EXPECT_EQ(&last.facets(), facets);
    EXPECT_EQ(last.points().data(), points);
    EXPECT_EQ(last.facets().normals.size(), 6u);
    EXPECT_DOUBLE_EQ(last.volume(), 8);
}

TEST(Polyhedron, LooksToTheEnginesLikeItsCornersAndFaces) {
    const Polyhedron cube = *Polyhedron::build(cube_grid(2, 1));
    const abut::detail::Convex<3> seen = convex(cube);
    EXPECT_EQ(seen.core, abut::detail::Core::points);
    EXPECT_EQ(seen.count, 8u);
    EXPECT_EQ(seen.vertices(), cube.points().data());
    EXPECT_EQ(seen.facets, &cube.facets());
    EXPECT_EQ(bounds(seen), (abut::Aabb3{Vec3(0), Vec3(1)}));

    const abut::detail::Convex<3> segment = convex(*Polyhedron::build({{0, 0, 0}, {1, 1, 1}}));
    EXPECT_EQ(segment.count, 2u);
    EXPECT_EQ(segment.facets, nullptr);
    EXPECT_EQ(bounds(convex(Polyhedron())), (abut::Aabb3{Vec3(0), Vec3(0)}));
}

TEST(Polyhedron, TakesAnyContiguousPoints) {
    const std::array<Vec3, 2> array{Vec3(0), Vec3(1)};
    const std::vector<Vec3> vector(array.begin(), array.end());
    const Vec3 c_array[] = {array[0], array[1]};
    for (const auto& built : {Polyhedron::build(array), Polyhedron::build(vector), Polyhedron::build(c_array),
                              Polyhedron::build(std::span<const Vec3>(vector))})
        EXPECT_EQ(corners(*built), vector);
}

// The centroid of a body of two parts is their weighted mean: a tetrahedron cut off a cube.
TEST(Polyhedron, CentroidsAddUp) {
    const Polyhedron cube = *Polyhedron::build(cube_grid(1, 4));
    std::vector<Vec3> rest = cube_grid(1, 4);
    const Vec3 cut[] = {{0, 0, 3}, {0, 3, 0}, {3, 0, 0}};
    rest[0] = cut[0];
    rest.insert(rest.end(), {cut[1], cut[2]});
    const Polyhedron body = *Polyhedron::build(rest), corner = *Polyhedron::build({Vec3(0), cut[0], cut[1], cut[2]});
    EXPECT_DOUBLE_EQ(body.volume() + corner.volume(), 64);
    const abut::detail::DVec<3> mean = (abut::detail::DVec<3>(body.centroid()) * body.volume() +
                                        abut::detail::DVec<3>(corner.centroid()) * corner.volume()) /
                                       cube.volume();
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(mean[i], 2, 1e-6);
}

// A thin plate's centroid is in its middle, even though its volume is tiny.
TEST(Polyhedron, CentroidOfAThinPlateIsItsMiddle) {
    abut::oracle::Random random(81);
    for (const double thickness : {1e-2, 1e-4, 1e-6}) {
        SCOPED_TRACE(thickness);
        std::vector<Vec3> points;
        const abut::detail::DVec<3> x = random.direction<3>(), z = abut::detail::perpendicular(x),
                                    y = abut::detail::cross(z, x);
        for (const double i : {-1.0, 1.0})
            for (const double j : {-1.0, 1.0})
                for (const double k : {-1.0, 1.0})
                    points.push_back(abut::detail::to_float(x * i + y * j + z * k * thickness));
        const Polyhedron plate = *Polyhedron::build(points);
        EXPECT_LT(length(abut::detail::DVec<3>(plate.centroid())), 3e-8 / thickness + 1e-6);
        EXPECT_NEAR(plate.volume() / (8 * thickness), 1, 1e-7 / thickness);
    }
}

}  // namespace
