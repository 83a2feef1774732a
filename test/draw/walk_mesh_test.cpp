#include "recorder.hpp"
#include <abut/draw/walk_mesh.hpp>
#include <abut/math/dvec.hpp>

#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using test::Recorder;

const Style mesh_style{{30, 60, 90, 255}, 2, {4, 5, 6, 70}};

/// Three unit squares in a row along x, a separate one 10 farther on, and a repeated triangle.
WalkMesh squares() {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    for (const float x : {0.0f, 1.0f, 2.0f, 12.0f}) {
        const auto first = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}});
        triangles.emplace_back(first, first + 1, first + 2);
        triangles.emplace_back(first, first + 2, first + 3);
    }
    triangles.push_back(triangles[0]);
    return *WalkMesh::build(points, triangles);
}

TEST(DrawWalkMesh, FillsTrianglesAndDrawsEachEdgeOnce) {
    Recorder<3> canvas({{-20, -20, -20}, {20, 20, 20}});
    draw(canvas, squares(), mesh_style);
    ASSERT_EQ(canvas.polygons.size(), 8u) << "not the one that is left out";
    EXPECT_EQ(canvas.polygons[0].style.fill, mesh_style.fill);
    EXPECT_EQ(canvas.polygons[0].style.stroke, transparent);
    std::size_t borders = 0, edges = 0;
    bool borders_last = true;
    for (const auto& line : canvas.lines) {
        const bool is_border = line.style.stroke == mesh_style.stroke;
        (is_border ? borders : edges) += 1;
        borders_last = borders_last && (is_border || borders == 0);
        EXPECT_EQ(line.style.width, is_border ? 2 : 1);
    }
    EXPECT_EQ(borders, 8u + 4);
    EXPECT_EQ(edges, 5u + 1);
    EXPECT_TRUE(borders_last);
}

TEST(DrawWalkMesh, LeavesOutWhatIsNotShown) {
    Recorder<3> canvas({{1.5f, 0, -1}, {5, 1, 1}});
    draw(canvas, squares());
    EXPECT_EQ(canvas.polygons.size(), 0u) << "this style fills nothing";
    for (const Vec3& place : canvas.places()) {
        EXPECT_GE(place.x, 1);
        EXPECT_LE(place.x, 3);
    }
    EXPECT_FALSE(canvas.lines.empty());
}

TEST(DrawWalkMesh, HasAStyleForEachTriangle) {
    Recorder<3> canvas({{-20, -20, -20}, {20, 20, 20}});
    const WalkMesh mesh = squares();
    draw(canvas, mesh, [&](std::uint32_t triangle) {
        Style style = mesh_style;
        style.fill.red = static_cast<std::uint8_t>(mesh.component(triangle));
        if (mesh.component(triangle) == 1) style.stroke = transparent;
        return style;
    });
    ASSERT_EQ(canvas.polygons.size(), 8u);
    for (const auto& area : canvas.polygons) EXPECT_EQ(area.style.fill.red, area.points[0].x > 5 ? 1 : 0);
    EXPECT_EQ(canvas.lines.size(), 8u + 5);
}

TEST(DrawWalkMesh, DrawsPaths) {
    Recorder<3> canvas;
    draw(canvas, WalkPath{});
    EXPECT_EQ(canvas.calls(), 0u);
    WalkPath path;
    path.points = {{0, 0, 0}};
    draw(canvas, path, mesh_style);
    EXPECT_EQ(canvas.points, path.points);
    EXPECT_EQ(canvas.calls(), 1u);
    Recorder<3> all;
    path.points = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {3, 2, 1}};
    draw(all, path, mesh_style);
    EXPECT_EQ(all.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}}));
    ASSERT_EQ(all.lines.size(), 3u);
    EXPECT_EQ(all.lines[1].b, Vec3(1, 2, 0));
    EXPECT_EQ(all.lines[2].a, Vec3(1, 2, 0));
    EXPECT_EQ(all.polygons.size(), 2u) << "the head, seen from all around";
    EXPECT_EQ(all.polygons[0].points[0], Vec3(3, 2, 1));
}

TEST(DrawWalkMesh, DrawsWalks) {
    Recorder<3> canvas;
    const WalkMesh mesh = squares();
    const WalkPoint from{1, {0.25f, 0.25f, 0.5f}};
    // The step reaches the far side, and slides along it.
    const Vec3 step(2, 1, 0);
    draw_walk(canvas, mesh, from, step, mesh_style);
    EXPECT_EQ(canvas.points, (std::vector<Vec3>{mesh.to_world(from)}));
    ASSERT_EQ(canvas.lines.size(), 64u + 1) << "its parts are too short for an arrow's head: one is drawn over them";
    for (std::size_t i = 0; i + 1 < 64; ++i) EXPECT_EQ(canvas.lines[i].b, canvas.lines[i + 1].a);
    EXPECT_GT(length(DVec<3>(canvas.lines[64].a) - DVec<3>(canvas.lines[63].b)), 1);
    canvas.lines.pop_back();
    const DVec<3> start(mesh.to_world(from)), end(mesh.to_world(mesh.walk(from, step).place));
    EXPECT_LT(length(DVec<3>(canvas.polygons.back().points[0]) - end), 1e-5);
    for (const auto& line : canvas.lines) {
        EXPECT_LE(line.b.y, 1);
        if (line.b.y < 0.999f) {
            EXPECT_NEAR(line.b.y - start.y, 0.5 * (line.b.x - start.x), 1e-5);
        }
    }
    Recorder<3> still;
    draw_walk(still, mesh, from, Vec3(0), mesh_style);
    EXPECT_EQ(still.calls(), 1u);
}

}  // namespace
}  // namespace abut
