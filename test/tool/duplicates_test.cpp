#include "tool/faults/duplicates.hpp"

#include "level_of.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace abut::tool {
namespace {

Duplicates<3> duplicates_of(Scene scene) {
    const test::SpaceLevel level(std::move(scene));
    return find_duplicates(level.view_of().objects);
}

TEST(Duplicates, GroupsOfObjectsInOnePlace) {
    Scene scene;
    for (const char* name : {"a", "b", "c"}) test::add_unit_box(scene, name, {1, 2, 3});
    test::add_unit_box(scene, "d", {1, 2, 3.1});
    test::add_object(scene, "e", test::box_triangles({0.5f, 0.5f, 0.6f}),
                     glm::translate(glm::dmat4(1.0), glm::dvec3(1, 2, 3)));
    const Duplicates<3> found = duplicates_of(std::move(scene));
    ASSERT_EQ(found.groups.size(), 1u);
    EXPECT_EQ(found.groups[0].objects, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(found.groups[0].apart, 0);
    EXPECT_EQ(found.groups[0].position, Vec3(1, 2, 3));
    EXPECT_TRUE(found.facets.empty());
}

TEST(Duplicates, ACopyMayBeALittleOff) {
    for (const auto& [off, is_copy] : {std::pair(5e-4, true), std::pair(5e-3, false)}) {
        Scene scene;
        test::add_unit_box(scene, "a", {0, 0, 0});  // its size is 0.87
        test::add_unit_box(scene, "b", {off, 0, 0});
        const Duplicates<3> found = duplicates_of(std::move(scene));
        ASSERT_EQ(found.groups.size(), is_copy ? 1u : 0u) << off;
        if (is_copy) {
            EXPECT_NEAR(found.groups[0].apart, off, 1e-6);
        }
    }
}

TEST(Duplicates, TheOrderOfCornersAndTrianglesDoesntMatter) {
    test::Triangles shuffled = test::corner_triangles(2);
    const auto count = static_cast<std::uint32_t>(shuffled.points.size());
    std::reverse(shuffled.points.begin(), shuffled.points.end());
    for (glm::uvec3& t : shuffled.triangles) t = {count - 1 - t.y, count - 1 - t.z, count - 1 - t.x};
    std::rotate(shuffled.triangles.begin(), shuffled.triangles.begin() + 7, shuffled.triangles.end());
    Scene scene;
    test::add_object(scene, "a", test::corner_triangles(2));
    test::add_object(scene, "b", shuffled);
    EXPECT_EQ(duplicates_of(scene).groups.size(), 1u);

    // Equal corners with other triangles are another mesh.
    std::swap(scene.geometries[1].triangles[0].x, scene.geometries[1].triangles[5].x);
    EXPECT_TRUE(duplicates_of(scene).groups.empty());
}

TEST(Duplicates, TurnedOntoItselfACubeIsThereTwice) {
    Scene scene;
    test::add_unit_box(scene, "a", {0, 0, 0});
    const std::uint32_t b = test::add_unit_box(scene, "b", {0, 0, 0});
    // Its other diagonals coincide with those of the first.
    scene.nodes[b].local = glm::dmat4(0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1);
    EXPECT_EQ(duplicates_of(std::move(scene)).groups.size(), 1u);
}

TEST(Duplicates, TrianglesOfOneMesh) {
    test::Triangles doubled = test::corner_triangles(2);
    const glm::uvec3 t = doubled.triangles[4], u = doubled.triangles[9];
    const std::size_t count = doubled.triangles.size();
    doubled.triangles.emplace_back(t.y, t.z, t.x);
    doubled.triangles.emplace_back(u.x, u.z, u.y);  // the other side of a sheet
    Scene scene;
    test::add_object(scene, "a", doubled);
    const Duplicates<3> found = duplicates_of(std::move(scene));
    ASSERT_EQ(found.facets.size(), 1u);
    EXPECT_EQ(found.facets[0].count, 1u);
    EXPECT_EQ(found.facets[0].first, count);
    EXPECT_EQ(found.facets[0].objects, 1u);
}

TEST(Duplicates, InThePlane) {
    test::PlaneLevel level;
    level.add("a", {{0, 0}, {2, 0}, {0, 1}});
    level.add("b", {{2, 0}, {0, 1}, {0, 0}});
    level.add("c", {{2, 0}, {0, 1.5f}, {0, 0}});
    const Duplicates<2> found = find_duplicates(level.view_of().objects);
    ASSERT_EQ(found.groups.size(), 1u);
    EXPECT_EQ(found.groups[0].objects, (std::vector<std::size_t>{0, 1}));
}

}  // namespace
}  // namespace abut::tool
