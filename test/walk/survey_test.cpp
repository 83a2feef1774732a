// Connected components, borders and non-manifold places of walk meshes.

#include "../oracle/random.hpp"
#include "../shape/meshes.hpp"
#include "walk_surfaces.hpp"
#include <abut/math/dvec.hpp>
#include <abut/walk/survey.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;
using test::built;
using test::Surface;

/// Unit squares in the plane z = 0, counter-clockwise from above.
Surface floor_of(int columns, int rows, const std::function<bool(int, int)>& is_floor) {
    Surface result;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto at = [&](int i, int j) { return Vec3(static_cast<float>(x + i), static_cast<float>(y + j), 0); };
            if (is_floor(x, y)) result.add_quad({at(0, 0), at(1, 0), at(1, 1), at(0, 1)}, (x + y) % 2 == 0);
        }
    return result;
}

/// Twice the signed area of a loop in the plane, above zero if counter-clockwise.
double turned_round(const WalkBorder& border) {
    double result = 0;
    for (std::size_t i = 0; i < border.points.size(); ++i) {
        const DVec<3> a(border.points[i]), b(border.points[(i + 1) % border.points.size()]);
        result += a.x * b.y - a.y * b.x;
    }
    return result;
}

TEST(WalkSurvey, ReportsAFloorWithPillars) {
    const WalkMesh mesh = built(floor_of(7, 5, [](int x, int y) { return !(y == 2 && (x == 1 || x == 4 || x == 5)); }));
    const WalkSurvey found = survey(mesh);
    ASSERT_EQ(found.components.size(), 1u);
    EXPECT_EQ(found.components[0].triangles, 64u);
    EXPECT_DOUBLE_EQ(found.components[0].area, 32);
    EXPECT_EQ(found.components[0].box, (Aabb3{{0, 0, 0}, {7, 5, 0}}));
    EXPECT_TRUE(mesh.is_walkable(found.components[0].place.triangle));
    ASSERT_EQ(found.borders.size(), 3u);
    EXPECT_TRUE(found.borders[0].is_rim);
    EXPECT_EQ(found.borders[0].points.size(), 24u);
    EXPECT_DOUBLE_EQ(found.borders[0].length, 24);
    EXPECT_DOUBLE_EQ(turned_round(found.borders[0]), 2 * 35) << "the floor is to the left";
    for (const std::size_t hole : {1u, 2u}) EXPECT_FALSE(found.borders[hole].is_rim);
    EXPECT_EQ(std::minmax(found.borders[1].length, found.borders[2].length), std::minmax(4.0, 6.0));
    EXPECT_DOUBLE_EQ(turned_round(found.borders[1]) + turned_round(found.borders[2]), -2 * 3);
    EXPECT_TRUE(found.non_manifold_vertices.empty());
    EXPECT_TRUE(found.non_manifold_edges.empty());
    EXPECT_TRUE(found.mirrored.empty());
}

TEST(WalkSurvey, ReportsComponentsByTheirFirstTriangles) {
    Surface surface = floor_of(2, 1, [](int, int) { return true; });
    Surface far = floor_of(3, 3, [](int x, int y) { return x != 1 || y != 1; });
    for (Vec3& p : far.points) p = Vec3(p.y, 4, p.x) * 2.0f;
    const WalkMesh mesh = built(joined(surface, far));
    const WalkSurvey found = survey(mesh);
    ASSERT_EQ(found.components.size(), 2u);
    EXPECT_DOUBLE_EQ(found.components[0].area, 2);
    EXPECT_DOUBLE_EQ(found.components[1].area, 32);
    EXPECT_EQ(found.components[1].box, (Aabb3{{0, 8, 0}, {6, 8, 6}}));
    for (std::uint32_t i = 0; i < 2; ++i) EXPECT_EQ(mesh.component(found.components[i].place.triangle), i);
    ASSERT_EQ(found.borders.size(), 3u);
    for (const std::size_t i : {0u, 1u, 2u}) EXPECT_EQ(found.borders[i].component, i == 0 ? 0u : 1u);
    EXPECT_NE(found.borders[1].is_rim, found.borders[2].is_rim);
    EXPECT_DOUBLE_EQ(found.borders[1].length + found.borders[2].length, 24 + 8);
}

TEST(WalkSurvey, PlacesLieInTheMiddleOfTheLargestTriangle) {
    Surface surface = floor_of(3, 1, [](int, int) { return true; });
    surface.points.push_back({1, 9, 0});
    surface.triangles.emplace_back(2u, 3u, 12u);
    const WalkMesh mesh = built(surface);
    const WalkSurvey found = survey(mesh);
    ASSERT_EQ(found.components.size(), 1u);
    EXPECT_EQ(found.components[0].place.triangle, 6u);
    const DVec<3> off = DVec<3>(mesh.to_world(found.components[0].place)) - DVec<3>(2.0 / 3, 11.0 / 3, 0);
    EXPECT_LT(length(off), 1e-6);
}

TEST(WalkSurvey, ClosedSurfacesHaveNoBorder) {
    const WalkSurvey found = survey(built(test::box_surface({-1, -1, -1}, {1, 1, 1})));
    ASSERT_EQ(found.components.size(), 1u);
    EXPECT_DOUBLE_EQ(found.components[0].area, 24);
    EXPECT_TRUE(found.borders.empty());
}

TEST(WalkSurvey, TheBorderOfAMoebiusStripIsOneLoop) {
    constexpr std::uint32_t around = 16;
    const WalkSurvey found = survey(built(test::twisted_strip(around, 1, 1)));
    ASSERT_EQ(found.borders.size(), 1u);
    EXPECT_EQ(found.borders[0].points.size(), 2 * around);
    ASSERT_EQ(found.mirrored.size(), 1u);
    const DVec<3> across = DVec<3>(found.mirrored[0].to) - DVec<3>(found.mirrored[0].from);
    EXPECT_GT(length(across), 0.5);
}

TEST(WalkSurvey, ReportsNonManifoldVerticesAndEdges) {
    // Two pillars that share a corner: the passage is closed between them, so that one border goes around both.
    const WalkSurvey non_manifold_vertices =
        survey(built(floor_of(4, 4, [](int x, int y) { return (x != 1 || y != 1) && (x != 2 || y != 2); })));
    EXPECT_EQ(non_manifold_vertices.non_manifold_vertices, (std::vector<Vec3>{{2, 2, 0}}));
    ASSERT_EQ(non_manifold_vertices.borders.size(), 2u);
    for (const WalkBorder& border : non_manifold_vertices.borders)
        EXPECT_DOUBLE_EQ(border.length, border.is_rim ? 16 : 8);

    Surface wall = floor_of(2, 1, [](int, int) { return true; });
    wall.add_quad({Vec3{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}, false);
    const WalkSurvey non_manifold_edges = survey(built(wall));
    ASSERT_EQ(non_manifold_edges.non_manifold_edges.size(), 1u);
    EXPECT_EQ(non_manifold_edges.non_manifold_edges[0].from + non_manifold_edges.non_manifold_edges[0].to,
              Vec3(2, 1, 0));
    EXPECT_EQ(non_manifold_edges.components.size(), 2u) << "the floor goes on below the wall";
}

/// Compares a survey with a reference implementation by `beyond`.
void expect_reference_survey(const WalkMesh& mesh) {
    const WalkSurvey found = survey(mesh);
    const WalkMeshReport& report = mesh.report();
    EXPECT_EQ(found.components.size(), report.components);
    EXPECT_EQ(found.non_manifold_vertices.size(), report.non_manifold_vertices);
    EXPECT_EQ(found.non_manifold_edges.size(), report.non_manifold_edges);
    EXPECT_EQ(found.mirrored.size(), report.mirrored);

    using Edge = std::tuple<float, float, float, float, float, float>;
    const auto corner = [&](std::uint32_t t, std::uint32_t k) {
        return mesh.points()[mesh.triangles()[t][static_cast<glm::length_t>(k % 3)]] + Vec3(0.0f);
    };
    const auto edge = [](Vec3 a, Vec3 b) {
        if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
        return Edge{a.x, a.y, a.z, b.x, b.y, b.z};
    };
    std::vector<Edge> expected, reported;
    std::vector<std::array<float, 3>> non_manifold_vertices, reported_vertices;
    const auto count = static_cast<std::uint32_t>(mesh.triangles().size());
    std::vector<std::tuple<std::array<float, 3>, std::uint32_t>> at;
    for (std::uint32_t t = 0; t < count; ++t) {
        if (!mesh.is_walkable(t)) continue;
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (!mesh.beyond({t, k})) expected.push_back(edge(corner(t, k), corner(t, k + 1)));
            const Vec3 p = corner(t, k);
            at.push_back({{p.x, p.y, p.z}, t});
        }
    }
    std::sort(at.begin(), at.end());
    for (std::size_t begin = 0, end = 0; begin < at.size(); begin = end) {
        const std::array<float, 3> place = std::get<0>(at[begin]);
        std::vector<std::uint32_t> here, reached;
        for (end = begin; end < at.size() && std::get<0>(at[end]) == place; ++end) here.push_back(std::get<1>(at[end]));
        const Vec3 p{place[0], place[1], place[2]};
        reached.push_back(here[0]);
        for (std::size_t i = 0; i < reached.size(); ++i)
            for (std::uint32_t k = 0; k < 3; ++k) {
                if (corner(reached[i], k) != p && corner(reached[i], k + 1) != p) continue;
                const std::optional<WalkSide> next = mesh.beyond({reached[i], k});
                if (next && std::find(reached.begin(), reached.end(), next->triangle) == reached.end())
                    reached.push_back(next->triangle);
            }
        if (reached.size() < here.size()) non_manifold_vertices.push_back(place);
    }
    for (const Vec3& p : found.non_manifold_vertices) reported_vertices.push_back({p.x, p.y, p.z});
    std::sort(reported_vertices.begin(), reported_vertices.end());
    EXPECT_EQ(reported_vertices, non_manifold_vertices);

    std::vector<double> rims(report.components, -1), longest(report.components, -1);
    for (const WalkBorder& border : found.borders) {
        double length = 0;
        for (std::size_t i = 0; i < border.points.size(); ++i) {
            const Vec3 &a = border.points[i], &b = border.points[(i + 1) % border.points.size()];
            reported.push_back(edge(a, b));
            length += detail::length(DVec<3>(b) - DVec<3>(a));
        }
        EXPECT_NEAR(border.length, length, 1e-9);
        longest[border.component] = std::max(longest[border.component], border.length);
        if (border.is_rim) {
            EXPECT_EQ(rims[border.component], -1) << "two rims";
            rims[border.component] = border.length;
        }
    }
    EXPECT_EQ(rims, longest);
    std::sort(expected.begin(), expected.end());
    std::sort(reported.begin(), reported.end());
    EXPECT_EQ(reported, expected);

    std::size_t triangles = 0;
    for (std::uint32_t i = 0; i < found.components.size(); ++i) {
        triangles += found.components[i].triangles;
        EXPECT_EQ(mesh.component(found.components[i].place.triangle), i);
    }
    EXPECT_EQ(triangles, count - report.duplicates - report.left_out);
}

TEST(WalkSurvey, EqualsTheReference) {
    std::size_t borders = 0, non_manifold_vertices = 0, mirrored = 0, non_manifold_edges = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Surface soup;
        const std::uint32_t points = 5 + random.below(15), triangles = 1 + random.below(40);
        for (std::uint32_t i = 0; i < points; ++i) soup.points.push_back(to_float(random.in_cube<3>()));
        for (std::uint32_t i = 0; i < triangles; ++i) {
            glm::uvec3 t;
            for (int k = 0; k < 3; ++k) t[k] = random.below(points);
            soup.triangles.push_back(t);
        }
        const Result<WalkMesh> mesh = WalkMesh::build(soup.points, soup.triangles);
        if (!mesh) continue;
        expect_reference_survey(*mesh);
        borders += mesh->report().border;
        non_manifold_vertices += mesh->report().non_manifold_vertices;
        mirrored += mesh->report().mirrored;
        non_manifold_edges += mesh->report().non_manifold_edges;
    }
    EXPECT_GT(borders, 1000u);
    EXPECT_GT(non_manifold_vertices, 300u);
    EXPECT_GT(mirrored, 20u);
    EXPECT_GT(non_manifold_edges, 300u);
    Random random(9);
    expect_reference_survey(built(floor_of(30, 30, [&](int, int) { return random.chance(0.7); })));
}

}  // namespace
}  // namespace abut
