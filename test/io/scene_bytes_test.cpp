#include <abut/io/mesh/scene_bytes.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

Scene full_scene() {
    Scene scene;
    scene.geometries.push_back(
        {"Box", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {{0, 0, 1}, {0, 1, 0}, {2, 0, 0}}});
    scene.nodes.resize(2);
    scene.nodes[0].name = "Root";
    scene.nodes[1].name = "Crate";
    scene.nodes[1].parent = 0;
    scene.nodes[1].geometries = {0};
    scene.nodes[1].local[3] = {1, 2, 3, 1};
    Animation animation;
    animation.name = "Walk";
    animation.start = 1;
    animation.length = 2;
    animation.motions.resize(1);
    animation.motions[0].node = 1;
    animation.motions[0].translation = {Interpolation::cubic, {0}, {{1, 2, 3}}, {{4, 5, 6}}, {{7, 8, 9}}};
    animation.motions[0].rotation = {Interpolation::step, {0, 1}, {{1, 0, 0, 0}, {0, 1, 0, 0}}, {}, {}};
    scene.animations.push_back(animation);
    scene.warnings = {"one", "two"};
    return scene;
}

TEST(SceneBytes, GoThereAndBack) {
    const std::vector<std::byte> bytes = detail::to_bytes(full_scene());
    const Result<Scene> scene = detail::scene_from_bytes(bytes);
    ASSERT_TRUE(scene);
    EXPECT_EQ(detail::to_bytes(*scene), bytes);
    EXPECT_EQ(scene->nodes[1].name, "Crate");
    EXPECT_EQ(scene->nodes[1].local, full_scene().nodes[1].local);
    EXPECT_EQ(scene->geometries[0].triangles, full_scene().geometries[0].triangles);
    EXPECT_EQ(scene->geometries[0].normals, full_scene().geometries[0].normals);
    EXPECT_EQ(scene->animations[0].motions[0].rotation.values[1], glm::dquat(0, 1, 0, 0));
    EXPECT_EQ(scene->warnings.size(), 2u);
}

TEST(SceneBytes, BringProblems) {
    const Result<Scene> scene =
        detail::scene_from_bytes(detail::to_bytes(Problem{ProblemCode::degenerate, "zero area", 7}));
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.problem().code, ProblemCode::degenerate);
    EXPECT_EQ(scene.problem().message, "zero area");
    EXPECT_EQ(scene.problem().index, 7u);
}

TEST(SceneBytes, NothingLessAndNothingMoreIsAScene) {
    std::vector<std::byte> bytes = detail::to_bytes(full_scene());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        ASSERT_FALSE(detail::scene_from_bytes(std::span(bytes).first(size))) << size;
    bytes.push_back(std::byte{0});
    EXPECT_FALSE(detail::scene_from_bytes(bytes));
}

TEST(SceneBytes, WhatPointsNowhereIsNoScene) {
    const auto refuses = [](auto&& change) {
        Scene scene = full_scene();
        change(scene);
        return !detail::scene_from_bytes(detail::to_bytes(scene));
    };
    EXPECT_FALSE(refuses([](Scene&) {}));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.geometries[0].triangles[0].y = 3; }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.geometries[0].normals.pop_back(); }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.nodes[1].parent = 1; }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.nodes[0].parent = 1; }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.nodes[1].geometries[0] = 1; }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.animations[0].motions[0].node = 2; }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.animations[0].motions[0].rotation.values.pop_back(); }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.animations[0].motions[0].translation.in_tangents.clear(); }));
}

TEST(SceneBytes, AnyByteChangedIsStillSafe) {
    const std::vector<std::byte> bytes = detail::to_bytes(full_scene());
    std::size_t refused = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        for (const unsigned flip : {0x01u, 0x80u, 0xffu}) {
            std::vector<std::byte> changed = bytes;
            changed[i] ^= static_cast<std::byte>(flip);
            refused += detail::scene_from_bytes(changed) ? 0 : 1;
        }
    EXPECT_GT(refused, bytes.size() / 3);
}

}  // namespace
}  // namespace abut
