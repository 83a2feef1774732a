// The clock and the node tree of a scene, with known answers.

#include <abut/io/scene.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace abut {
namespace {

NodeMotion sliding(std::uint32_t node, std::vector<double> times, std::vector<double> xs) {
    NodeMotion motion;
    motion.node = node;
    motion.translation.times = std::move(times);
    for (const double x : xs) motion.translation.values.emplace_back(x, 0, 0);
    return motion;
}

Animation clip(NodeMotion motion) {
    Animation animation;
    animation.length = motion.translation.times.back();
    animation.motions.push_back(std::move(motion));
    return animation;
}

Scene two_nodes() {
    Scene scene;
    scene.nodes.resize(2);
    scene.nodes[0].name = "parent";
    scene.nodes[1].name = "child";
    scene.nodes[1].parent = 0;
    scene.nodes[1].local[3] = {0, 5, 0, 1};
    return scene;
}

double x_at(const Scene& scene, std::size_t node, double time) {
    std::vector<glm::dmat4> matrices;
    world_matrices(scene, time, matrices);
    return matrices[node][3][0];
}

TEST(Scene, PathLeavesOutHelpers) {
    Scene scene = two_nodes();
    EXPECT_EQ(path(scene, 1), "parent/child");
    scene.nodes[0].name.clear();
    EXPECT_EQ(path(scene, 1), "child");
    EXPECT_EQ(path(scene, 0), "");
}

TEST(Scene, ChildrenFollowTheirParents) {
    Scene scene = two_nodes();
    scene.animations.push_back(clip(sliding(0, {0, 2}, {0, 8})));
    schedule(scene);
    std::vector<glm::dmat4> matrices;
    world_matrices(scene, 0.5, matrices);
    EXPECT_EQ(matrices[1][3], glm::dvec4(2, 5, 0, 1));
}

TEST(Scene, MotionStaysBeforeTheFirstKeyAndAfterTheLast) {
    Scene scene = two_nodes();
    scene.animations.push_back(clip(sliding(0, {1, 2}, {3, 4})));
    schedule(scene);
    EXPECT_EQ(x_at(scene, 0, 0), 3);
    EXPECT_EQ(x_at(scene, 0, 9), 4);
}

TEST(Scene, StepsHoldTheirValue) {
    Scene scene = two_nodes();
    scene.animations.push_back(clip(sliding(0, {0, 1, 2}, {0, 10, 20})));
    scene.animations[0].motions[0].translation.interpolation = Interpolation::step;
    schedule(scene);
    EXPECT_EQ(x_at(scene, 0, 0.99), 0);
    EXPECT_EQ(x_at(scene, 0, 1), 10);
}

TEST(Scene, CubicKeysFollowTheirTangents) {
    Scene scene = two_nodes();
    scene.animations.push_back(clip(sliding(0, {0, 2}, {0, 0})));
    KeyTrack<glm::dvec3>& track = scene.animations[0].motions[0].translation;
    track.interpolation = Interpolation::cubic;
    track.in_tangents = {{0, 0, 0}, {-4, 0, 0}};
    track.out_tangents = {{4, 0, 0}, {0, 0, 0}};
    schedule(scene);
    // Half way: 2 s * (1/8 * 4 - -1/8... ) = 2 * (0.125 * 4 + 0.125 * 4).
    EXPECT_DOUBLE_EQ(x_at(scene, 0, 1), 2);
    EXPECT_EQ(x_at(scene, 0, 2), 0);
}

TEST(Scene, RotationsTakeTheShortestArc) {
    Scene scene = two_nodes();
    Animation animation;
    animation.length = 1;
    animation.motions.resize(1);
    KeyTrack<glm::dquat>& track = animation.motions[0].rotation;
    const double half = std::sqrt(0.5);
    track.times = {0, 1};
    track.values = {glm::dquat(1, 0, 0, 0), glm::dquat(-half, 0, 0, -half)};  // a quarter turn about z, negated
    scene.animations.push_back(animation);
    schedule(scene);
    std::vector<glm::dmat4> matrices;
    world_matrices(scene, 0.5, matrices);
    EXPECT_NEAR(matrices[1][3][0], -5 * std::sin(std::numbers::pi / 4), 1e-12);
    EXPECT_NEAR(matrices[1][3][1], 5 * std::cos(std::numbers::pi / 4), 1e-12);
}

TEST(Scene, PartsWithoutKeysStayAsTheyAre) {
    Scene scene = two_nodes();
    scene.nodes[0].local = glm::dmat4(0.0);
    scene.nodes[0].local[0] = {0, 2, 0, 0};  // a quarter turn about z, stretched by 2 3 -4
    scene.nodes[0].local[1] = {-3, 0, 0, 0};
    scene.nodes[0].local[2] = {0, 0, -4, 0};
    scene.nodes[0].local[3] = {7, 8, 9, 1};
    scene.animations.push_back(clip(sliding(0, {0, 1}, {1, 2})));
    schedule(scene);
    std::vector<glm::dmat4> matrices;
    world_matrices(scene, 0, matrices);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            EXPECT_NEAR(matrices[0][column][row], scene.nodes[0].local[column][row], 1e-12) << column << row;
    EXPECT_EQ(matrices[0][3], glm::dvec4(1, 0, 0, 1));
}

TEST(Scene, KeyTimesAreThinned) {
    Scene scene = two_nodes();
    EXPECT_EQ(key_times(scene), std::vector<double>{0.0});
    std::vector<double> times;
    std::vector<double> xs;
    for (int i = 0; i <= 240; ++i) {
        times.push_back(i / 240.0);
        xs.push_back(i);
    }
    scene.animations.push_back(clip(sliding(0, times, xs)));
    schedule(scene);
    const std::vector<double> limited = key_times(scene);
    EXPECT_EQ(limited.size(), 31u);
    EXPECT_EQ(limited.front(), 0);
    EXPECT_EQ(limited.back(), 1);
    for (std::size_t i = 1; i + 1 < limited.size(); ++i) EXPECT_GE(limited[i] - limited[i - 1], 0.99 / 30);
    EXPECT_EQ(key_times(scene, 1000).size(), 241u);
}

TEST(Scene, FrameTimesAreEven) {
    Scene scene = two_nodes();
    EXPECT_EQ(frame_times(scene, 5), std::vector<double>{0.0});
    scene.animations.push_back(clip(sliding(0, {1, 1.1, 3}, {0, 0, 0})));
    schedule(scene);
    EXPECT_EQ(frame_times(scene, 5), (std::vector<double>{1, 1.5, 2, 2.5, 3}));
    EXPECT_EQ(frame_times(scene, 1), std::vector<double>{1.0});
}

TEST(Scene, ClipsOfDifferentNodesRunTogetherOthersInTurn) {
    Scene scene = two_nodes();
    scene.animations.push_back(clip(sliding(0, {0, 1}, {0, 1})));
    scene.animations.push_back(clip(sliding(1, {0, 2}, {0, 0})));
    scene.animations.push_back(clip(sliding(0, {0, 1}, {10, 20})));
    schedule(scene);
    EXPECT_EQ(scene.animations[0].start, 0);
    EXPECT_EQ(scene.animations[1].start, 0);
    EXPECT_GT(scene.animations[2].start, 1);
    EXPECT_EQ(x_at(scene, 0, 1), 1) << "the first clip's end is not yet the third one's beginning";
    EXPECT_EQ(x_at(scene, 0, scene.animations[2].start), 10);
    EXPECT_EQ(key_times(scene).size(), 5u);
}

}  // namespace
}  // namespace abut
