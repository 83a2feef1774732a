#include "tool/faults/leaks.hpp"

#include "level_of.hpp"

#include <gtest/gtest.h>

namespace abut::tool {
namespace {

std::vector<LevelLeak> leaks_of(const test::Triangles& triangles, bool meant_closed = false) {
    Scene scene;
    test::add_object(scene, "Thing", triangles);
    const test::SpaceLevel level(std::move(scene));
    if (!meant_closed) return find_leaks(level.view_of().objects, nullptr);
    return find_leaks(level.view_of().objects, [](const ViewedObject<3>&) { return true; });
}

test::Triangles cube() {
    return test::box_triangles({1, 1, 1});
}

/// A flat square of n x n cells with edges of length 1, each of two triangles.
test::Triangles sheet(std::uint32_t n) {
    test::Triangles result;
    for (std::uint32_t row = 0; row <= n; ++row)
        for (std::uint32_t column = 0; column <= n; ++column)
            result.points.emplace_back(static_cast<float>(column), 0.0f, static_cast<float>(row));
    for (std::uint32_t row = 0; row < n; ++row)
        for (std::uint32_t column = 0; column < n; ++column) {
            const std::uint32_t a = row * (n + 1) + column, b = a + n + 1;
            result.triangles.emplace_back(a, b, b + 1);
            result.triangles.emplace_back(a, b + 1, a + 1);
        }
    return result;
}

TEST(Leaks, WhatIsClosedHasNone) {
    EXPECT_TRUE(leaks_of(cube(), true).empty());
    EXPECT_TRUE(leaks_of(test::inside_out(cube()), true).empty());
    EXPECT_TRUE(leaks_of(test::corner_triangles(2), true).empty());
}

TEST(Leaks, AMissingTriangleIsAHole) {
    test::Triangles open = cube();
    open.triangles.erase(open.triangles.begin() + 3);
    EXPECT_TRUE(leaks_of(open).empty()) << "a large one";
    const std::vector<LevelLeak> leaks = leaks_of(open, true);
    ASSERT_EQ(leaks.size(), 1u);
    EXPECT_EQ(leaks[0].kind, LeakKind::hole);
    EXPECT_EQ(leaks[0].count, 3u);
    EXPECT_FLOAT_EQ(leaks[0].length, 4 + std::sqrt(8.0f));
    EXPECT_FLOAT_EQ(leaks[0].extent, std::sqrt(8.0f));
    EXPECT_NEAR(leaks[0].share, 2.0 / 22, 1e-6);
}

TEST(Leaks, IntendedOpeningsAreReportedOnlyOnRequest) {
    EXPECT_TRUE(leaks_of(sheet(4)).empty());
    const std::vector<LevelLeak> border = leaks_of(sheet(4), true);
    ASSERT_EQ(border.size(), 1u);
    EXPECT_EQ(border[0].count, 16u);
    EXPECT_FLOAT_EQ(border[0].length, 16);
    EXPECT_EQ(border[0].center, Vec3(2, 0, 2));
    test::Triangles bucket = cube();
    std::erase_if(bucket.triangles, [&](const glm::uvec3& t) {
        return bucket.points[t.x].y > 0 && bucket.points[t.y].y > 0 && bucket.points[t.z].y > 0;
    });
    ASSERT_EQ(bucket.triangles.size(), 10u);
    EXPECT_TRUE(leaks_of(bucket).empty());
    EXPECT_EQ(leaks_of(bucket, true).size(), 1u);
}

TEST(Leaks, AHoleInAGroundIsOneThoughItsBorderIsNone) {
    test::Triangles ground = sheet(5);
    ground.triangles.erase(ground.triangles.begin() + 24, ground.triangles.begin() + 26);  // the cell in the middle
    const std::vector<LevelLeak> leaks = leaks_of(ground);
    ASSERT_EQ(leaks.size(), 1u);
    EXPECT_EQ(leaks[0].count, 4u);
    EXPECT_EQ(leaks[0].center, Vec3(2.5f, 0, 2.5f));
}

TEST(Leaks, SeparateCardsAreNoHolesOfAll) {
    // Each leaf of a tree is small relative to the tree, and only borders relative to itself.
    test::Triangles leaves;
    for (std::uint32_t i = 0; i < 50; ++i) {
        const auto x = static_cast<float>(3 * i);
        leaves.points.insert(leaves.points.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
        leaves.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    EXPECT_TRUE(leaks_of(leaves).empty());
}

TEST(Leaks, TJunctionsAreCracksAndNoHoles) {
    // The top edge of one side of the cube has an additional corner, which its other triangle doesn't have.
    test::Triangles split = cube();
    const glm::uvec3 t = split.triangles[0];
    const auto middle = static_cast<std::uint32_t>(split.points.size());
    split.points.push_back((split.points[t.x] + split.points[t.y]) * 0.5f);
    split.triangles[0] = {t.x, middle, t.z};
    split.triangles.emplace_back(middle, t.y, t.z);
    const std::vector<LevelLeak> leaks = leaks_of(split, true);
    ASSERT_EQ(leaks.size(), 1u);
    EXPECT_EQ(leaks[0].kind, LeakKind::crack);
    EXPECT_EQ(leaks[0].count, 2u);
    EXPECT_FLOAT_EQ(leaks[0].length, glm::distance(split.points[t.x], split.points[t.y]));

    // With the corner beside the edge there is a visible hole.
    split.points[middle] *= 0.9f;
    const std::vector<LevelLeak> holes = leaks_of(split, true);
    ASSERT_EQ(holes.size(), 1u);
    EXPECT_EQ(holes[0].kind, LeakKind::hole);
    EXPECT_EQ(holes[0].count, 3u);
}

TEST(Leaks, ASeamOfCornersThatAreNearlyTheSameIsACrack) {
    test::Triangles seam = sheet(2);
    // One triangle with separate corners, slightly moved.
    for (int corner = 0; corner < 3; ++corner) {
        seam.points.push_back(seam.points[seam.triangles[0][corner]] + Vec3(0, 1e-5f, 0));
        seam.triangles[0][corner] = static_cast<std::uint32_t>(seam.points.size()) - 1;
    }
    const std::vector<LevelLeak> leaks = leaks_of(seam);
    ASSERT_EQ(leaks.size(), 1u);
    EXPECT_EQ(leaks[0].kind, LeakKind::crack);
    EXPECT_EQ(leaks[0].count, 2u) << "its third edge is at the outer border";
}

TEST(Leaks, TrianglesWithReversedWinding) {
    test::Triangles flipped = cube();
    std::swap(flipped.triangles[7].y, flipped.triangles[7].z);
    std::swap(flipped.triangles[2].y, flipped.triangles[2].z);
    const std::vector<LevelLeak> leaks = leaks_of(flipped);
    ASSERT_EQ(leaks.size(), 1u);
    EXPECT_EQ(leaks[0].kind, LeakKind::flipped);
    EXPECT_EQ(leaks[0].count, 2u);
    EXPECT_EQ(leaks[0].triangle, 2u);
}

TEST(Leaks, AFinMakesANonManifoldEdge) {
    test::Triangles fin = cube();
    const glm::uvec3 t = fin.triangles[0];
    fin.points.push_back(fin.points[t.x] * 3.0f);
    fin.triangles.emplace_back(t.x, t.y, static_cast<std::uint32_t>(fin.points.size()) - 1);
    const std::vector<LevelLeak> leaks = leaks_of(fin);
    ASSERT_EQ(leaks.size(), 1u);
    EXPECT_EQ(leaks[0].kind, LeakKind::non_manifold);
    EXPECT_EQ(leaks[0].count, 1u);
}

TEST(Leaks, ASheetWithTwoSidesIsASheet) {
    test::Triangles both = sheet(3);
    const std::vector<glm::uvec3> front = both.triangles;
    for (const glm::uvec3& t : front) both.triangles.emplace_back(t.x, t.z, t.y);
    EXPECT_TRUE(leaks_of(both).empty());
}

TEST(Leaks, AMeshIsReportedOnceWithAllItsObjects) {
    test::Triangles open = cube();
    open.triangles.pop_back();
    Scene scene;
    test::add_object(scene, "A", open);
    SceneNode copy = scene.nodes[0];
    copy.name = "B";
    copy.local[3] = {9, 0, 0, 1};
    scene.nodes.push_back(copy);
    const test::SpaceLevel level(std::move(scene));
    const std::vector<LevelLeak> leaks =
        find_leaks(level.view_of().objects, [](const ViewedObject<3>& object) { return object.name == "B"; });
    ASSERT_EQ(leaks.size(), 1u);
    EXPECT_EQ(leaks[0].object, 0u);
    EXPECT_EQ(leaks[0].objects, 2u);
}

}  // namespace
}  // namespace abut::tool
