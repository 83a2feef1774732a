// Building a walk mesh: for each line of the report, a mesh with only that.

#include "../oracle/expect.hpp"
#include "../shape/meshes.hpp"
#include "walk_surfaces.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using test::built;
using test::Surface;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// The unit square at height 0, both triangles counter-clockwise from above, cut from (0, 0) to (1, 1).
Surface square() {
    return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// Triangles from the edge (0, 0, 0) - (0, 0, 1) to these points, all with the same winding.
Surface book(const std::vector<Vec2>& pages) {
    Surface result{{{0, 0, 0}, {0, 0, 1}}, {}};
    for (const Vec2& page : pages) {
        result.triangles.emplace_back(0u, 1u, result.points.size());
        result.points.emplace_back(page.x, page.y, 0.5f);
    }
    return result;
}

/// The page across the book's spine, the edge between points 0 and 1 in either direction.
std::optional<std::uint32_t> beyond_spine(const WalkMesh& mesh, std::uint32_t page) {
    const glm::uvec3 t = mesh.triangles()[page];
    for (std::uint32_t side = 0; side < 3; ++side) {
        const auto k = static_cast<glm::length_t>(side);
        if (t[k] + t[(k + 1) % 3] != 1) continue;
        const std::optional<WalkSide> there = mesh.beyond({page, side});
        return there ? std::optional(there->triangle) : std::nullopt;
    }
    ADD_FAILURE() << "page " << page << " has no spine";
    return std::nullopt;
}

double area_of(const WalkMesh& mesh, std::uint32_t i) {
    const glm::uvec3 t = mesh.triangles()[i];
    const DVec<3> a(mesh.points()[t.x]), b(mesh.points()[t.y]), c(mesh.points()[t.z]);
    return length(cross(b - a, c - a)) / 2;
}

/// Checks that the half-edge across each side links back to it.
void expect_symmetric_adjacency(const WalkMesh& mesh) {
    std::size_t borders = 0;
    for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t)
        for (std::uint32_t side = 0; side < 3; ++side) {
            if (!mesh.is_walkable(t)) {
                EXPECT_EQ(mesh.beyond({t, side}), std::nullopt);
                continue;
            }
            const std::optional<WalkSide> there = mesh.beyond({t, side});
            if (!there) {
                ++borders;
                continue;
            }
            EXPECT_TRUE(mesh.is_walkable(there->triangle));
            EXPECT_EQ(mesh.beyond(*there), (WalkSide{t, side}));
            EXPECT_EQ(mesh.component(there->triangle), mesh.component(t));
        }
    EXPECT_EQ(borders, mesh.report().border);
}

TEST(WalkBuild, TakesASquareAsItIs) {
    const Surface surface = square();
    const WalkMesh mesh = built(surface);
    EXPECT_EQ(mesh.report(), (WalkMeshReport{.border = 4, .components = 1}));
    EXPECT_FALSE(changed(mesh.report()));
    EXPECT_EQ(described(mesh.report()), "1 component, 4 border edges");
    EXPECT_EQ(std::vector<Vec3>(mesh.points().begin(), mesh.points().end()), surface.points);
    EXPECT_EQ(std::vector<glm::uvec3>(mesh.triangles().begin(), mesh.triangles().end()), surface.triangles);
    EXPECT_EQ(mesh.beyond({0, 2}), (WalkSide{1, 0}));
    EXPECT_EQ(mesh.beyond({1, 0}), (WalkSide{0, 2}));
    for (const WalkSide& side : {WalkSide{0, 0}, WalkSide{0, 1}, WalkSide{1, 1}, WalkSide{1, 2}})
        EXPECT_EQ(mesh.beyond(side), std::nullopt);
    EXPECT_EQ(bounds(mesh), (Aabb3{{0, 0, 0}, {1, 1, 0}}));
    EXPECT_EQ(mesh.to_world({0, {1, 0, 0}}), Vec3(0, 0, 0));
    EXPECT_EQ(mesh.to_world({0, {0, 0, 1}}), Vec3(1, 1, 0));
    EXPECT_EQ(mesh.to_world({1, {0.25f, 0.25f, 0.5f}}), Vec3(0.25f, 0.75f, 0));
    EXPECT_EQ(mesh.normal({0, {1, 0, 0}}), Vec3(0, 0, 1));
}

TEST(WalkBuild, JoinsByPositionsNotByNumbers) {
    // Each triangle with corners of its own, one of them at -0.
    const Surface apart{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0f, 0, -0.0f}, {1, 1, 0}, {0, 1, 0}},
                        {{0, 1, 2}, {3, 4, 5}}};
    const WalkMesh mesh = built(apart);
    EXPECT_EQ(mesh.report(), (WalkMeshReport{.border = 4, .components = 1}));
    EXPECT_EQ(mesh.beyond({0, 2}), (WalkSide{1, 0}));
    EXPECT_EQ(mesh.triangles()[1], glm::uvec3(3, 4, 5)) << "the order of triangles is unchanged";
    EXPECT_EQ(mesh.points().size(), 6u);

    Surface cracked = apart;
    cracked.points[4].x = std::nextafter(1.0f, 2.0f);
    EXPECT_EQ(built(cracked).report(), (WalkMeshReport{.border = 6, .non_manifold_vertices = 1, .components = 2}))
        << "what is one rounding apart is apart";
}

TEST(WalkBuild, LeavesOutAllButTheFirstOfDoubles) {
    Surface surface = square();
    surface.triangles = {{0, 1, 2}, {2, 0, 1}, {0, 2, 3}, {1, 0, 2}};
    const WalkMesh mesh = built(surface);
    EXPECT_EQ(mesh.report(), (WalkMeshReport{.duplicates = 2, .border = 4, .components = 1}));
    EXPECT_TRUE(changed(mesh.report()));
    EXPECT_EQ(described(mesh.report()), "1 component, 2 triangles there twice, 4 border edges");
    EXPECT_TRUE(mesh.is_walkable(0) && mesh.is_walkable(2));
    EXPECT_FALSE(mesh.is_walkable(1) || mesh.is_walkable(3));
    EXPECT_EQ(mesh.triangles()[1], glm::uvec3(2, 0, 1)) << "as given";
    EXPECT_EQ(mesh.beyond({0, 2}), (WalkSide{2, 0}));
    expect_symmetric_adjacency(mesh);
}

TEST(WalkBuild, CutsTheNeighbourOfATriangleWithoutArea) {
    // The lower square's top has a vertex in its middle, the upper square's bottom has none: the triangle between them
    // is flat.
    const Surface surface{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}, {1, 2, 0}},
                          {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}, {4, 3, 2}, {4, 2, 5}}};
    const std::vector<std::uint8_t> areas{1, 2, 3, 4, 5};
    const Result<WalkMesh> result = WalkMesh::build(surface.points, surface.triangles, {}, areas);
    ASSERT_TRUE(result);
    const WalkMesh& mesh = *result;
    EXPECT_EQ(mesh.report(), (WalkMeshReport{.flat = 1, .border = 5, .components = 1}));
    EXPECT_TRUE(changed(mesh.report()));
    EXPECT_EQ(described(mesh.report()), "1 component, 1 triangle without area cut away, 5 border edges");
    for (std::uint32_t i = 0; i < 5; ++i) EXPECT_TRUE(mesh.is_walkable(i)) << i;
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(mesh.triangles()[i], surface.triangles[i]) << "untouched";
        EXPECT_EQ(mesh.area(i), areas[i]);
    }
    EXPECT_EQ(mesh.area(3), 5) << "a part of the triangle that was cut";
    EXPECT_EQ(mesh.area(4), 5);
    EXPECT_DOUBLE_EQ(area_of(mesh, 3), 0.5);
    EXPECT_DOUBLE_EQ(area_of(mesh, 4), 0.5);
    expect_symmetric_adjacency(mesh);
}

TEST(WalkBuild, LeavesOutTrianglesWithoutAreaThatNothingLiesBeyond) {
    Surface surface = square();
    surface.points.push_back({2, 0, 0});
    surface.triangles.emplace_back(0u, 1u, 4u);  // flat; its longest side is a border
    surface.triangles.emplace_back(2u, 2u, 3u);  // a corner twice
    const WalkMesh mesh = built(surface);
    EXPECT_EQ(mesh.report(), (WalkMeshReport{.left_out = 2, .border = 4, .components = 1}));
    EXPECT_EQ(described(mesh.report()), "1 component, 2 triangles without area left out, 4 border edges");
    EXPECT_FALSE(mesh.is_walkable(2) || mesh.is_walkable(3));
    EXPECT_EQ(mesh.triangles()[2], glm::uvec3(0, 1, 4)) << "as given";
    EXPECT_EQ(bounds(mesh), (Aabb3{{0, 0, 0}, {1, 1, 0}})) << "of what is walked on";
    expect_symmetric_adjacency(mesh);
}

TEST(WalkBuild, ATriangleWithTwoCornersAtOnePositionHasNoArea) {
    Surface surface = square();
    surface.points.push_back({1, 1, 0});
    surface.triangles.emplace_back(0u, 2u, 4u);
    const WalkMesh mesh = built(surface);
    EXPECT_EQ(mesh.report(), (WalkMeshReport{.left_out = 1, .border = 4, .components = 1}));
}

TEST(WalkBuild, TurnsTheFewToTheMany) {
    Surface surface = square();
    surface.points.insert(surface.points.end(), {{2, 0, 0}, {2, 1, 0}});
    surface.triangles = {{0, 1, 2}, {0, 3, 2}, {1, 4, 5}, {1, 5, 2}};
    const WalkMesh mesh = built(surface);
    EXPECT_EQ(mesh.report(), (WalkMeshReport{.turned = 1, .border = 6, .components = 1}));
    EXPECT_EQ(described(mesh.report()), "1 component, 1 triangle turned, 6 border edges");
    EXPECT_EQ(mesh.triangles()[1], glm::uvec3(0, 2, 3)) << "corners 1 and 2 exchanged";
    for (std::uint32_t i : {0u, 2u, 3u}) EXPECT_EQ(mesh.triangles()[i], surface.triangles[i]);
    for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(mesh.normal({i, {1, 0, 0}}), Vec3(0, 0, 1));
    // Weights refer to the new order of corners.
    EXPECT_EQ(mesh.to_world({1, {0, 1, 0}}), Vec3(1, 1, 0));
    expect_symmetric_adjacency(mesh);
}

TEST(WalkBuild, EachPatchKeepsItsOwnSide) {
    // A floor and a ceiling that faces down: no triangle is reversed, as no direction is up.
    const WalkMesh mesh = built(test::joined(square(), test::reversed(square())));
    EXPECT_EQ(mesh.report().duplicates, 2u);
    Surface ceiling = test::reversed(square());
    for (Vec3& point : ceiling.points) point.z = 3;
    const WalkMesh both = built(test::joined(square(), ceiling));
    EXPECT_EQ(both.report(), (WalkMeshReport{.border = 8, .components = 2}));
    EXPECT_EQ(both.normal({0, {1, 0, 0}}), Vec3(0, 0, 1));
    EXPECT_EQ(both.normal({2, {1, 0, 0}}), Vec3(0, 0, -1));
}

TEST(WalkBuild, OfThreeAtAnEdgeTheFlattestGoOn) {
    // A floor cut in two where a wall stands on it; the wall is the first, the second, the third.
    for (std::uint32_t wall = 0; wall < 3; ++wall) {
        std::vector<Vec2> pages{{1, 0}, {-1, 0}};
        pages.insert(pages.begin() + wall, {0.1f, 1});
        const WalkMesh mesh = built(book(pages));
        const std::uint32_t floor = wall == 0 ? 1 : 0, other = wall == 2 ? 1 : 2;
        EXPECT_EQ(beyond_spine(mesh, floor), other) << wall;
        EXPECT_EQ(beyond_spine(mesh, wall), std::nullopt);
        EXPECT_EQ(mesh.normal({floor, {1, 0, 0}}), mesh.normal({other, {1, 0, 0}})) << "one of them was turned";
        EXPECT_EQ(mesh.report().turned, 1u);
        EXPECT_EQ(mesh.report().mirrored, 0u);
        EXPECT_EQ(mesh.report().non_manifold_edges, 1u);
        EXPECT_EQ(mesh.report().border, 7u);
        EXPECT_EQ(mesh.report().components, 2u);
        EXPECT_TRUE(changed(mesh.report()));
        expect_symmetric_adjacency(mesh);
    }
}

TEST(WalkBuild, OfFourAtAnEdgeBothPairsGoOn) {
    // Two floors that cross at 30 degrees: each continues straight on, not back along the other.
    const WalkMesh mesh = built(book({{1, 0}, {-0.87f, -0.5f}, {0.87f, 0.5f}, {-1, 0.01f}}));
    EXPECT_EQ(beyond_spine(mesh, 0), 3u);
    EXPECT_EQ(beyond_spine(mesh, 1), 2u);
    EXPECT_EQ(mesh.report().non_manifold_edges, 1u);
    EXPECT_EQ(mesh.report().border, 8u);
    EXPECT_EQ(mesh.report().components, 2u);
    expect_symmetric_adjacency(mesh);
}

TEST(WalkBuild, NeighboursAtANonManifoldEdgeAreOrientedConsistently) {
    // Two halves of a floor with opposite winding and a wall between: the halves can be oriented consistently.
    Surface surface = book({{1, 0}, {-1, 0}, {0, 1}});
    const WalkMesh mesh = built(surface);
    EXPECT_EQ(mesh.report().mirrored, 0u);
    EXPECT_EQ(mesh.normal({0, {1, 0, 0}}), mesh.normal({1, {1, 0, 0}}));
    std::swap(surface.triangles[1].y, surface.triangles[1].z);
    const WalkMesh same = built(surface);
    EXPECT_EQ(same.report().mirrored, 0u);
    EXPECT_EQ(same.report().turned, 0u);
}

TEST(WalkBuild, AnEdgeOfMoreThan64IsABorder) {
    for (const std::size_t count : {std::size_t{64}, std::size_t{65}}) {
        std::vector<Vec2> pages;
        for (std::size_t i = 0; i < count; ++i) {
            const float x = static_cast<float>(i) - 31.9f;
            pages.emplace_back(x, 1000 - x * x);
        }
        const WalkMesh mesh = built(book(pages));
        EXPECT_EQ(mesh.report().non_manifold_edges, 1u);
        EXPECT_EQ(mesh.report().border, count == 64 ? 128u : 195u);
        EXPECT_EQ(mesh.report().components, count == 64 ? 32u : 65u);
        expect_symmetric_adjacency(mesh);
    }
}

TEST(WalkBuild, AMoebiusStripTurnsOverOnce) {
    // Three squares round a triangle, the last one joined to the first upside down.
    const Surface strip{{{0, 0, 0}, {0, 0, 1}, {2, 0, 0}, {2, 0, 1}, {1, 2, 0.2f}, {1, 2, 0.8f}},
                        {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}, {4, 1, 0}, {4, 0, 5}}};
    const WalkMesh mesh = built(strip);
    EXPECT_EQ(mesh.report().mirrored, 1u);
    EXPECT_EQ(mesh.report().components, 1u);
    EXPECT_EQ(mesh.report().border, 6u);
    EXPECT_EQ(mesh.report().non_manifold_vertices, 0u);
    EXPECT_NE(described(mesh.report()).find("1 edge where the surface turns over"), std::string::npos);
    expect_symmetric_adjacency(mesh);
}

TEST(WalkBuild, BowTiesAreNonManifold) {
    const Surface bow{{{0, 0, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}};
    const WalkMesh mesh = built(bow);
    EXPECT_EQ(mesh.report(), (WalkMeshReport{.border = 6, .non_manifold_vertices = 1, .components = 2}));
    EXPECT_FALSE(changed(mesh.report())) << "nothing was done about it";
    EXPECT_EQ(described(mesh.report()), "2 components, 1 non-manifold vertex, 6 border edges");

    // Two squares that share a corner, and a path around from one to the other: one component, but a non-manifold
    // vertex.
    Surface ring{{}, {}};
    const auto add = [&](float x, float y) {
        ring.add_quad({Vec3(x, y, 0), {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}}, false);
    };
    add(0, 0);
    add(1, 1);
    add(2, 1);
    add(2, 0);
    add(2, -1);
    add(1, -1);
    add(0, -1);
    const WalkMesh round = built(ring);
    EXPECT_EQ(round.report().non_manifold_vertices, 1u);
    EXPECT_EQ(round.report().components, 1u);
}

TEST(WalkBuild, CountsComponentsInTheOrderOfTheirFirstTriangles) {
    Surface surface = square();
    for (int i = 1; i < 4; ++i) {
        Surface other = square();
        for (Vec3& point : other.points) point.x += 5 * static_cast<float>(i);
        surface = test::joined(surface, other);
    }
    surface.triangles.insert(surface.triangles.begin(), {3, 3, 3});
    std::swap(surface.triangles[2], surface.triangles[8]);
    const WalkMesh mesh = built(surface);
    EXPECT_EQ(mesh.report(), (WalkMeshReport{.left_out = 1, .border = 16, .components = 4}));
    const std::vector<std::uint32_t> expected{0, 0, 1, 2, 2, 3, 3, 1, 0};
    for (std::uint32_t i = 1; i < 9; ++i) EXPECT_EQ(mesh.component(i), expected[i]) << i;
}

TEST(WalkBuild, NamesWhatIsWrong) {
    const Surface good = square();
    const auto expect_problem = [](const Result<WalkMesh>& result, ProblemCode code, const std::string& message,
                                   std::size_t index) {
        ASSERT_FALSE(result);
        EXPECT_EQ(result.problem().code, code) << result.problem().message;
        EXPECT_EQ(result.problem().message, message);
        EXPECT_EQ(result.problem().index, index);
    };
    const auto with_point = [&](const Vec3& point) {
        std::vector<Vec3> points = good.points;
        points[2] = point;
        return WalkMesh::build(points, good.triangles);
    };
    expect_problem(WalkMesh::build(good.points, {}), ProblemCode::empty_input,
                   "a walk mesh needs at least one triangle", 0);
    expect_problem(WalkMesh::build({}, {}), ProblemCode::empty_input, "a walk mesh needs at least one triangle", 0);
    expect_problem(with_point({0, nan, 0}), ProblemCode::not_finite, "point 2 has a coordinate that is not finite", 2);
    expect_problem(with_point({0, 0, -2e15f}), ProblemCode::too_large, "point 2 has a coordinate above 1e15", 2);
    EXPECT_TRUE(with_point({1e15f, -1e15f, 1e15f}));
    expect_problem(WalkMesh::build(good.points, std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 4}}),
                   ProblemCode::index_out_of_range, "triangle 1 names point 4 of 4", 1);
    expect_problem(WalkMesh::build(good.points, std::vector<glm::uvec3>{{0, 1, 1}, {2, 2, 2}}), ProblemCode::degenerate,
                   "no triangle of the walk mesh has an area", 0);
    const std::vector<Vec3> in_line{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}};
    expect_problem(WalkMesh::build(in_line, std::vector<glm::uvec3>{{0, 1, 2}}), ProblemCode::degenerate,
                   "no triangle of the walk mesh has an area", 0);
    std::vector<Vec3> normals(3, Vec3(0, 0, 1));
    expect_problem(WalkMesh::build(good.points, good.triangles, normals), ProblemCode::bad_argument,
                   "3 normals of 4 points", 0);
    normals.emplace_back(0, nan, 0);
    expect_problem(WalkMesh::build(good.points, good.triangles, normals), ProblemCode::not_finite,
                   "normal 3 is not finite", 3);
    const std::vector<std::uint8_t> areas{1};
    expect_problem(WalkMesh::build(good.points, good.triangles, {}, areas), ProblemCode::bad_argument,
                   "1 areas of 2 triangles", 0);
}

TEST(WalkBuild, CopiesShareTheirData) {
    std::optional<WalkMesh> first = built(square());
    const WalkMesh copy = *first;
    EXPECT_EQ(&copy.data(), &first->data());
    first.reset();
    EXPECT_EQ(copy.to_world({0, {0, 0, 1}}), Vec3(1, 1, 0));
}

}  // namespace
}  // namespace abut
