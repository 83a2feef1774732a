#include "scene_of.hpp"
#include "tool/objects/scene_objects.hpp"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace abut::tool {
namespace {

using test::box_triangles;

TEST(Objects, AreSortedByPath) {
    Scene scene;
    test::add_unit_box(scene, "b", {0, 0, 0});
    test::add_unit_box(scene, "c", {0, 0, 0});
    test::add_unit_box(scene, "a", {0, 0, 0});
    scene.nodes[2].parent = 1;
    const SceneObjects objects(scene);
    ASSERT_EQ(objects.size(), 3u);
    EXPECT_EQ(objects[0].path, "b");
    EXPECT_EQ(objects[1].path, "c");
    EXPECT_EQ(objects[2].path, "c/a");
    EXPECT_EQ(objects[2].name, "a");
}

TEST(Objects, TellBodiesFromSurfaces) {
    Scene scene;
    test::add_object(scene, "1 box", box_triangles({1, 2, 3}));
    test::add_object(scene, "2 room", test::inside_out(box_triangles({1, 2, 3})));
    test::add_object(scene, "3 corner", test::corner_triangles(1));
    test::Triangles open = box_triangles({1, 2, 3});
    open.triangles.pop_back();
    test::add_object(scene, "4 open", open);
    // Wound inwards in the file, and turned right side out by a mirror.
    test::add_object(scene, "5 mirrored", test::inside_out(box_triangles({1, 2, 3})),
                     glm::scale(glm::dmat4(1.0), {-1, 1, 1}));
    test::add_object(scene, "6 mirrored", box_triangles({1, 2, 3}), glm::scale(glm::dmat4(1.0), {-1, 1, 1}));
    SceneObjects objects(scene);
    ASSERT_FALSE(objects.go_to(0));
    const bool solid[] = {true, false, false, false, false, true};
    const bool filled[] = {false, false, true, false, false, false};
    for (std::size_t i = 0; i < objects.size(); ++i) {
        EXPECT_EQ(objects[i].solid, solid[i]) << objects[i].path;
        EXPECT_EQ(objects[i].filled, filled[i]) << objects[i].path;
        EXPECT_TRUE(objects[i].present);
    }
}

TEST(Objects, PrimitivesOfOneNodeAreOneBody) {
    Scene scene;
    test::Triangles box = box_triangles({1, 1, 1});
    test::Triangles half = box;
    half.triangles.resize(5);
    box.triangles.erase(box.triangles.begin(), box.triangles.begin() + 5);
    test::add_object(scene, "box", half);
    scene.geometries.push_back({"rest", box.points, box.triangles});
    scene.nodes[0].geometries.push_back(1);
    SceneObjects objects(scene);
    ASSERT_FALSE(objects.go_to(0));
    EXPECT_TRUE(objects[0].solid);
}

TEST(Objects, ShearIsBakedIn) {
    // A box turned by 45 degrees about z below a parent stretched along x: its top corner goes nowhere, its right one
    // twice as far.
    Scene scene;
    SceneNode parent;
    parent.name = "parent";
    parent.local = glm::scale(glm::dmat4(1.0), {2, 1, 1});
    scene.nodes.push_back(parent);
    const std::uint32_t child = test::add_object(scene, "child", box_triangles({1, 1, 1}),
                                                 glm::rotate(glm::dmat4(1.0), glm::radians(45.0), {0, 0, 1}));
    scene.nodes[child].parent = 0;
    SceneObjects objects(scene);
    ASSERT_FALSE(objects.go_to(0));
    EXPECT_TRUE(objects[0].solid);
    const float root = std::sqrt(2.0f);
    EXPECT_NEAR(objects[0].box.max.x, 2 * root, 1e-5f);
    EXPECT_NEAR(objects[0].box.max.y, root, 1e-5f);
    EXPECT_NEAR(objects[0].box.max.z, 1, 1e-5f);
}

TEST(Objects, TurningKeepsTheShapeStretchingDoesNot) {
    Scene scene;
    test::add_object(scene, "box", box_triangles({1, 2, 3}));
    Animation animation;
    animation.length = 3;
    animation.motions.resize(1);
    animation.motions[0].rotation.times = {0, 1};
    animation.motions[0].rotation.values = {glm::dquat(1, 0, 0, 0), glm::angleAxis(1.0, glm::dvec3(0, 0, 1))};
    animation.motions[0].scale.times = {1, 2};
    animation.motions[0].scale.values = {{1, 1, 1}, {1, 4, 1}};
    scene.animations.push_back(animation);
    schedule(scene);
    SceneObjects objects(scene);
    ASSERT_FALSE(objects.go_to(0));
    const auto points = [&] { return std::get<Polyhedron>(objects.shape(0)).points().data(); };
    const Vec3* const before = points();
    ASSERT_FALSE(objects.go_to(1));
    EXPECT_EQ(points(), before);
    EXPECT_TRUE(objects[0].moved);
    EXPECT_NEAR(objects[0].box.max.x, std::cos(1.0f) + 2 * std::sin(1.0f), 1e-5f);
    ASSERT_FALSE(objects.go_to(2));
    EXPECT_NE(points(), before);
    EXPECT_NEAR(objects[0].box.max.x, std::cos(1.0f) + 8 * std::sin(1.0f), 1e-5f);
    ASSERT_FALSE(objects.go_to(3));
    EXPECT_FALSE(objects[0].moved);
}

TEST(Objects, AreAwayWhileShrunkToNothing) {
    Scene scene;
    test::add_object(scene, "coin", box_triangles({1, 1, 1}));
    Animation animation;
    animation.length = 2;
    animation.motions.resize(1);
    animation.motions[0].scale.times = {0, 1, 2};
    animation.motions[0].scale.values = {{1, 1, 1}, {0, 0, 0}, {1, 1, 1}};
    scene.animations.push_back(animation);
    schedule(scene);
    SceneObjects objects(scene);
    ASSERT_FALSE(objects.go_to(0));
    EXPECT_TRUE(objects[0].present);
    EXPECT_TRUE(objects.hidden().empty());
    ASSERT_FALSE(objects.go_to(1));
    EXPECT_FALSE(objects[0].present);
    EXPECT_EQ(objects.hidden(), std::vector<std::string>{"coin"});
    ASSERT_FALSE(objects.go_to(2));
    EXPECT_TRUE(objects[0].present);
    EXPECT_TRUE(objects[0].moved);
}

TEST(Objects, FlattenedToAPlaneTheyStay) {
    Scene scene;
    test::add_object(scene, "floor", box_triangles({1, 1, 1}), glm::scale(glm::dmat4(1.0), {5, 0, 5}));
    SceneObjects objects(scene);
    ASSERT_FALSE(objects.go_to(0));
    EXPECT_TRUE(objects[0].present);
    EXPECT_FALSE(objects[0].solid);
    EXPECT_FLOAT_EQ(objects[0].box.max.x, 5);
    EXPECT_NEAR(objects[0].box.max.y, 0, 1e-6f);
}

TEST(Objects, OutOfRangeIsAProblem) {
    for (const double scale : {1e39, 1e300}) {
        Scene scene;
        const std::uint32_t parent = test::add_object(scene, "big", box_triangles({1, 1, 1}),
                                                      glm::scale(glm::dmat4(1.0), {scale, scale, scale}));
        scene.nodes.push_back(scene.nodes[parent]);
        scene.nodes[1].parent = parent;
        scene.nodes[0].geometries.clear();
        SceneObjects objects(scene);
        const std::optional<Problem> problem = objects.go_to(0);
        ASSERT_TRUE(problem) << scale;
        EXPECT_EQ(problem->message, "object 'big/big': its transform takes it out of the range of floats");
    }
}

}  // namespace
}  // namespace abut::tool
