// Polygons that are triangulated separately, stitched into one surface.

#include <abut/math/dvec.hpp>
#include <abut/recast/stitch.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <algorithm>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

WalkMesh mesh_of(const Stitched& surface) {
    std::vector<Vec3> points;
    for (const DVec<3>& point : surface.points) points.push_back(to_float(point));
    return *WalkMesh::build(points, surface.triangles);
}

/// Two adjacent squares, from x = 0 to 1 and to 2, each as corners and two triangles.
const std::vector<DVec<3>> corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 1}};
CutPolygon square(std::uint32_t first) {
    CutPolygon result{{first, first + 3, first + 4, first + 1}, {}, {{0, 1, 2}, {0, 2, 3}}};
    for (const std::uint32_t i : result.corners) result.points.push_back(corners[i]);
    return result;
}

double area_of(const Stitched& surface) {
    double sum = 0;
    for (const glm::uvec3& t : surface.triangles) {
        const DVec<3> a = surface.points[t.x];
        sum += 0.5 * cross(surface.points[t.y] - a, surface.points[t.z] - a).y;
    }
    return sum;
}

TEST(Stitch, LeavesWhatFitsAsItIs) {
    const std::vector<CutPolygon> polygons{square(0), square(1)};
    const Stitched surface = stitch(corners, polygons, {});
    EXPECT_EQ(surface.points, corners);
    EXPECT_EQ(surface.triangles.size(), 4u);
    EXPECT_EQ(surface.repaired, 0u);
    EXPECT_DOUBLE_EQ(area_of(surface), 2);
    EXPECT_EQ(mesh_of(surface).report().border, 6u);
}

TEST(Stitch, CutsBothSidesAtThePointsOfEither) {
    CutPolygon left = square(0), right = square(1);
    // The left one has a point in the middle of the common edge, and one inside; the right one has two others on the
    // edge.
    left.points.push_back({1, 0.2, 0.5});
    left.points.push_back({0.5, 0.1, 0.5});
    left.triangles = {{0, 1, 5}, {1, 2, 5}, {2, 4, 5}, {4, 3, 5}, {3, 0, 5}};
    right.points.push_back({1, 0.3, 0.75});
    right.points.push_back({1, 0.4, 0.5});
    right.triangles = {{0, 5, 3}, {5, 4, 3}, {4, 1, 3}, {1, 2, 3}};
    const std::vector<CutPolygon> polygons{left, right};
    const Stitched surface = stitch(corners, polygons, {});
    EXPECT_EQ(surface.repaired, 0u);
    EXPECT_DOUBLE_EQ(area_of(surface), 2);
    ASSERT_EQ(surface.points.size(), 9u);
    const auto has = [&](const DVec<3>& point) {
        return std::find(surface.points.begin(), surface.points.end(), point) != surface.points.end();
    };
    EXPECT_TRUE(has({1, (0.2 + 0.4) / 2, 0.5})) << "at the mean of both heights";
    EXPECT_TRUE(has({1, 0.3, 0.75}));
    EXPECT_TRUE(has({0.5, 0.1, 0.5}));
    const WalkMeshReport report = mesh_of(surface).report();
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.border, 6u) << "the side between them is no border";
    EXPECT_FALSE(changed(report));
}

TEST(Stitch, JoinsCornersAboveOneAnother) {
    std::vector<DVec<3>> doubled = corners;
    doubled.push_back({1, 0.1, 0});
    doubled.push_back({1, 0.2, 1});
    CutPolygon right = square(1);
    right.corners = {6, 7, 5, 2};
    right.points = {doubled[6], doubled[7], doubled[5], doubled[2]};
    right.triangles = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<CutPolygon> polygons{square(0), right};
    EXPECT_EQ(mesh_of(stitch(doubled, polygons, {.step = 0.25})).report().components, 1u);
    EXPECT_EQ(mesh_of(stitch(doubled, polygons, {.step = 0.15})).report().components, 2u)
        << "only one of them is joined";
}

TEST(Stitch, CutsAnewWhatItsTrianglesDoNotFill) {
    CutPolygon left = square(0), right = square(1);
    left.triangles.pop_back();
    right.triangles.push_back({0, 1, 3});
    right.points.push_back({1, 0.5, 0.5});
    const std::vector<CutPolygon> polygons{left, right};
    const Stitched surface = stitch(corners, polygons, {});
    EXPECT_EQ(surface.repaired, 2u);
    EXPECT_DOUBLE_EQ(area_of(surface), 2);
    const WalkMeshReport report = mesh_of(surface).report();
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.border, 6u);
    EXPECT_FALSE(changed(report));
}

TEST(Stitch, CutsSidesAtTheCornersOfPolygonsWithoutArea) {
    // The right one has a vertex in the middle of the common edge; the triangle between them is flat.
    std::vector<DVec<3>> more = corners;
    more.push_back({1, 0.3, 0.5});
    CutPolygon right{{1, 6, 4, 5, 2}, {}, {{0, 1, 4}, {1, 2, 3}, {1, 3, 4}}}, thin{{1, 4, 6}, {}, {{0, 1, 2}}};
    for (CutPolygon* polygon : {&right, &thin})
        for (const std::uint32_t i : polygon->corners) polygon->points.push_back(more[i]);
    const std::vector<CutPolygon> polygons{square(0), thin, right};
    const Stitched surface = stitch(more, polygons, {});
    EXPECT_EQ(surface.repaired, 0u);
    EXPECT_EQ(surface.points, more);
    EXPECT_DOUBLE_EQ(area_of(surface), 2);
    const WalkMeshReport report = mesh_of(surface).report();
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.border, 6u);
}

TEST(Stitch, TurnsAllUp) {
    CutPolygon other = square(0);
    for (glm::uvec3& t : other.triangles) std::swap(t.y, t.z);
    const std::vector<CutPolygon> polygons{other, square(1)};
    const Stitched surface = stitch(corners, polygons, {});
    EXPECT_EQ(surface.repaired, 0u);
    EXPECT_DOUBLE_EQ(area_of(surface), 2);
}

}  // namespace
}  // namespace abut
