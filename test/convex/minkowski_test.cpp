#include "../oracle/random.hpp"
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/minkowski.hpp>

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using Pairs = std::vector<CornerPair>;
using Loop = std::vector<DVec<2>>;

const Loop square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(SumOfLoops, OfTwoSquaresMakesParallelEdgesOne) {
    EXPECT_EQ(sum_corners(square, square), (Pairs{{0, 0}, {1, 1}, {2, 2}, {3, 3}}));
}

TEST(SumOfLoops, OfATriangleAndASquareHasTheEdgesOfBoth) {
    // From the triangle's least corner, given last: along the square's bottom, down the slope, and so on.
    const Loop triangle{{5, 4}, {3, 7}, {0, 5}};
    EXPECT_EQ(sum_corners(triangle, square), (Pairs{{2, 0}, {0, 0}, {0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}}));
}

TEST(SumOfLoops, OfPointsAndSegments) {
    const Loop point{{3, 4}}, across{{0, 0}, {2, 0}}, longer{{0, 1}, {5, 1}}, up{{0, 0}, {0, 2}};
    EXPECT_EQ(sum_corners(point, point), (Pairs{{0, 0}}));
    EXPECT_EQ(sum_corners(point, across), (Pairs{{0, 0}, {0, 1}}));
    EXPECT_EQ(sum_corners(across, point), (Pairs{{0, 0}, {1, 0}}));
    EXPECT_EQ(sum_corners(across, longer), (Pairs{{0, 0}, {1, 1}}));
    EXPECT_EQ(sum_corners(across, up), (Pairs{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(sum_corners(point, square), (Pairs{{0, 0}, {0, 1}, {0, 2}, {0, 3}}));
}

TEST(SumOfLoops, ComparesDirectionsExactly) {
    // cross((s + 1, s), (s, s - 1)) is -1, but the rounded products of s = 2^27 give 0.
    const double s = 0x1p27;
    const Loop steeper{{0, 0}, {s + 1, s}, {0, s}}, flatter{{0, 0}, {s, s - 1}, {0, s - 1}};
    EXPECT_EQ(sum_corners(steeper, flatter), (Pairs{{0, 0}, {0, 1}, {1, 1}, {2, 2}}));
    EXPECT_EQ(sum_corners(flatter, steeper), (Pairs{{0, 0}, {1, 0}, {1, 1}, {2, 2}}));
}

TEST(SumOfLoops, OfEdgesThatRoundToParallelOnes) {
    // Convex, but the first two edges differ by less than a double resolves. The third then seemed parallel to the
    // segment, and the sum lost its far end.
    const Loop sliver{{-1, -8}, {1e-20, 0}, {1, 8}}, segment{{-2, -16}, {2, 16}};
    const Pairs pairs = sum_corners(sliver, segment);
    EXPECT_NE(std::find(pairs.begin(), pairs.end(), CornerPair{2, 1}), pairs.end());
    EXPECT_EQ(pairs.front(), (CornerPair{0, 0}));
}

/// A polyhedron with the arrays that a surface refers to.
struct Body {
    explicit Body(std::vector<Vec3> points) : hull(*abut::hull(points)) {
        facets = {hull.normals, hull.loops, hull.loop_ends, hull.edges};
        for (const Vec3& point : hull.points) corners.emplace_back(point);
    }

    SummandSurface surface() const { return {corners, facets.edges.empty() ? nullptr : &facets, false}; }

    Hull3 hull;
    Facets facets;
    std::vector<DVec<3>> corners;
};

std::vector<Vec3> box_corners(const Vec3& half) {
    std::vector<Vec3> result;
    for (const float x : {-half.x, half.x})
        for (const float y : {-half.y, half.y})
            for (const float z : {-half.z, half.z}) result.push_back({x, y, z});
    return result;
}

Hull3 sum(const Body& a, const Body& b) {
    std::vector<Vec3> points;
    for (const CornerPair& pair : sum_corners(a.surface(), b.surface()))
        points.push_back(to_float(a.corners[pair.a] + b.corners[pair.b]));
    return *hull(points);
}

const Body tetrahedron({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
const Body mirrored_tetrahedron({{-1, -1, -1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}});

TEST(SumOfSurfaces, OfTwoBoxesIsABox) {
    const Body a(box_corners({1, 2, 3})), b(box_corners({0.5f, 0.25f, 4}));
    // All normals coincide and all arcs of the Gauss map overlap: each corner is added to the equal corner.
    Pairs expected;
    for (std::uint32_t i = 0; i < 8; ++i) expected.push_back({i, i});
    EXPECT_EQ(sum_corners(a.surface(), b.surface()), expected);
}

TEST(SumOfSurfaces, OfATetrahedronAndItselfIsTwiceThat) {
    const Hull3 twice = sum(tetrahedron, tetrahedron);
    EXPECT_EQ(twice.points.size(), 4u);
    EXPECT_NEAR(twice.volume, 8 * tetrahedron.hull.volume, 1e-12);
}

TEST(SumOfSurfaces, OfATetrahedronAndItsMirrorImageIsACuboctahedron) {
    // Four faces of each, and six squares where an edge of one crosses an edge of the other.
    const Hull3 cuboctahedron = sum(tetrahedron, mirrored_tetrahedron);
    EXPECT_EQ(cuboctahedron.points.size(), 12u);
    EXPECT_EQ(cuboctahedron.normals.size(), 14u);
}

TEST(SumOfSurfaces, TakesLoopsThatAreClockwise) {
    Body mirrored = tetrahedron;
    mirrored.facets = {mirrored.hull.normals, mirrored.hull.loops, mirrored.hull.loop_ends, mirrored.hull.edges};
    for (DVec<3>& corner : mirrored.corners) corner = -corner;
    const SummandSurface surface{mirrored.corners, &mirrored.facets, true};
    std::set<std::vector<double>> found, expected;
    for (const CornerPair& pair : sum_corners(tetrahedron.surface(), surface)) {
        const DVec<3> corner = tetrahedron.corners[pair.a] + mirrored.corners[pair.b];
        found.insert({corner.x, corner.y, corner.z});
    }
    for (const Vec3& corner : sum(tetrahedron, mirrored_tetrahedron).points) {
        const DVec<3> exact(corner);
        expected.insert({exact.x, exact.y, exact.z});
    }
    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
    EXPECT_LE(found.size(), expected.size() + 1);  // faces onto edges may add inner points
}

TEST(SumOfSurfaces, OfFlatOnesAndSegments) {
    const Body floor({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), upright({{0, 0, 0}, {0, 0, 2}, {0, 1, 0}});
    const Body segment({{0, 0, 0}, {0, 0, 3}}), point({{1, 2, 3}});
    EXPECT_EQ(sum(floor, floor).rank, 2);
    EXPECT_EQ(sum(floor, floor).points.size(), 4u);
    EXPECT_NEAR(sum(floor, upright).volume, 3, 1e-12);  // 1 wide; 1 x 2 and the triangle of area 1 across
    EXPECT_NEAR(sum(floor, segment).volume, 3, 1e-12);
    EXPECT_EQ(sum(segment, segment).points.size(), 2u);
    EXPECT_EQ(sum(segment, point).points, (std::vector<Vec3>{{1, 2, 3}, {1, 2, 6}}));
    EXPECT_EQ(sum(point, tetrahedron).points.size(), 4u);
}

TEST(SumOfSurfaces, OfLargeParallelFacesDoesNotTryAllPairs) {
    // Two prisms over 64 corners each: all of the 128 corners of one end are farthest along one direction.
    oracle::Random random(1);
    const auto prism = [&] {
        std::vector<Vec3> points;
        for (int i = 0; i < 64; ++i) {
            const DVec<2> around = random.direction<2>();
            for (const double z : {-1.0, 1.0}) points.push_back(to_float(DVec<3>(around.x, around.y, z)));
        }
        return Body(points);
    };
    const Body a = prism(), b = prism();
    const Pairs pairs = sum_corners(a.surface(), b.surface());
    EXPECT_LT(pairs.size(), 4u * 128u);
    EXPECT_EQ(sum(a, b).points.size(), 256u);
}

}  // namespace
}  // namespace abut
