#include "tool/faults/spawns.hpp"

#include "level_of.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace abut::tool {
namespace {

constexpr Character person{0.3f, 1.8f};

std::vector<SpawnFinding<3>> faults_of(Scene scene, const SpawnOptions<3>& options) {
    const test::SpaceLevel level(std::move(scene));
    return find_spawn_faults(level.view_of(), default_spawns(level.view_of()), options);
}

SpawnOptions<3> standing() {
    return {person, Vec3(0, 1, 0)};
}

Scene floor_and(const glm::dvec3& spawn) {
    Scene scene;
    test::add_box(scene, "Floor", {-9, -1, -9}, {9, 0, 9});
    test::add_place(scene, "Spawn", spawn);
    return scene;
}

TEST(Spawns, OnAFloorAllIsFine) {
    EXPECT_TRUE(faults_of(floor_and({0, 0, 0}), standing()).empty());
    EXPECT_TRUE(faults_of(floor_and({0, 0, 0}), {std::nullopt, Vec3(0, 1, 0)}).empty());
    EXPECT_TRUE(faults_of(floor_and({0, 3, 0}), standing()).empty()) << "somebody falls a little";
}

TEST(Spawns, InAFloorAndInAWall) {
    const std::vector<SpawnFinding<3>> sunk = faults_of(floor_and({0, -0.25, 0}), standing());
    ASSERT_EQ(sunk.size(), 1u);
    EXPECT_EQ(sunk[0].fault, SpawnFault::inside);
    EXPECT_EQ(sunk[0].object, 0u);
    EXPECT_NEAR(sunk[0].depth, 0.25, 1e-5);
    ASSERT_TRUE(sunk[0].free);
    EXPECT_NEAR(sunk[0].free->y, 0, 0.01);

    Scene scene = floor_and({0, 0, 0});
    test::add_box(scene, "Wall", {0.1, 0, -5}, {1, 3, 5});
    const std::vector<SpawnFinding<3>> wall = faults_of(scene, standing());
    ASSERT_EQ(wall.size(), 1u);
    EXPECT_EQ(wall[0].object, 1u);
    EXPECT_NEAR(wall[0].depth, 0.2, 1e-5);
    ASSERT_TRUE(wall[0].free);
    EXPECT_NEAR(wall[0].free->x, -0.2, 0.01);
    EXPECT_TRUE(faults_of(scene, {std::nullopt, Vec3(0, 1, 0)}).empty()) << "a point fits";
    EXPECT_TRUE(faults_of(scene, {Character{0.1f, 1.8f}, Vec3(0, 1, 0)}).empty()) << "somebody thinner as well";
}

TEST(Spawns, InABodyWhoseSurfaceIsFarAway) {
    for (const bool convex : {true, false}) {
        Scene scene;
        if (convex)
            test::add_box(scene, "Rock", {-3, -3, -3}, {3, 3, 3});
        else
            test::add_object(scene, "Rock", test::corner_triangles(6));
        test::add_place(scene, "Spawn", {-1.5, 0, 0});
        const std::vector<SpawnFinding<3>> found = faults_of(scene, standing());
        ASSERT_EQ(found.size(), 1u);
        EXPECT_EQ(found[0].fault, SpawnFault::inside);
        EXPECT_NEAR(found[0].depth, 1.8, 1e-4) << "1.5 to the surface, and its radius";
        ASSERT_TRUE(found[0].free);
        EXPECT_LT(found[0].free->x, -3.29f);
        const std::vector<SpawnFinding<3>> point = faults_of(scene, {std::nullopt, Vec3(0, 1, 0)});
        ASSERT_EQ(point.size(), 1u);
        EXPECT_NEAR(point[0].depth, 1.5, 1e-4);
    }
}

TEST(Spawns, OnASlope) {
    // The round end is in a slope through its lowest point, as far as the slope is no wall.
    for (const auto& [degrees, fine] : {std::pair(0.0, true), std::pair(35.0, true), std::pair(70.0, false)}) {
        Scene scene;
        test::add_object(scene, "Slope", test::box_triangles({9, 1, 9}),
                         glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::dvec3(0, 0, 1)) *
                             glm::translate(glm::dmat4(1.0), glm::dvec3(0, -1, 0)));
        test::add_place(scene, "Spawn", {0, 0, 0});
        EXPECT_EQ(faults_of(scene, standing()).empty(), fine) << degrees;
    }
}

TEST(Spawns, BelowAGroundAndAboveNothing) {
    test::Triangles ground;
    ground.points = {{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}};
    ground.triangles = {{0, 1, 2}, {0, 2, 3}};
    for (const bool sized : {true, false}) {
        SpawnOptions<3> options = standing();
        if (!sized) options.character.reset();
        Scene scene;
        test::add_object(scene, "Ground", ground);
        test::add_place(scene, "Spawn_1", {0, 0, 0});
        test::add_place(scene, "Spawn_2", {2, -4, 0});
        test::add_place(scene, "Spawn_3", {12, 0, 0});
        const std::vector<SpawnFinding<3>> found = faults_of(scene, options);
        ASSERT_EQ(found.size(), 2u);
        EXPECT_EQ(found[0].place, 2u);
        EXPECT_EQ(found[0].fault, SpawnFault::beneath);
        EXPECT_EQ(found[0].object, 0u);
        EXPECT_EQ(found[1].place, 3u);
        EXPECT_EQ(found[1].fault, SpawnFault::no_ground);
        options.up.reset();
        EXPECT_EQ(faults_of(scene, options).size(), sized ? 1u : 0u) << "seen from above, it is a ball in the ground";
    }
}

TEST(Spawns, MarksAreNoObstacles) {
    Scene scene = floor_and({0, 0, 0});
    test::add_box(scene, "Mark", {-0.2, 0, -0.2}, {0.2, 1, 0.2});
    scene.nodes.back().parent = 1;
    EXPECT_TRUE(faults_of(scene, standing()).empty());
    scene.nodes.back().parent = SceneNode::no_parent;
    EXPECT_EQ(faults_of(scene, standing()).size(), 1u);
}

TEST(Spawns, NamesAndPatterns) {
    Scene scene;
    test::add_box(scene, "Floor", {-9, -1, -9}, {9, 0, 9});
    for (const char* name : {"PLAYER_START.001", "Respawner", "Start", "spawns"}) test::add_place(scene, name, {});
    test::add_place(scene, "Spawn_A", {});
    scene.nodes.back().parent = 4;  // so that "spawns" is a group
    const test::SpaceLevel level(std::move(scene));
    std::vector<std::string> names;
    for (const std::size_t i : default_spawns(level.view_of())) names.push_back(level.view_of().places[i].path);
    EXPECT_EQ(names, (std::vector<std::string>{"PLAYER_START.001", "Respawner", "spawns/Spawn_A"}));
    EXPECT_EQ(matching_places(level.view_of(), "S*").size(), 2u) << "Start and Spawn_A";
    EXPECT_EQ(matching_places(level.view_of(), "spawns/*").size(), 1u);
    EXPECT_TRUE(matching_places(level.view_of(), "spawn").empty());
}

TEST(Spawns, OnAMapSeenFromAbove) {
    test::PlaneLevel level;
    level.add_box("Wall", {0, 0}, {4, 1});
    level.add_place("spawn 1", {2, 1.2f});
    level.add_place("spawn 2", {2, 0.25f});
    level.add_place("spawn 3", {2, 1.5f});
    const std::vector<std::size_t> spawns = default_spawns(level.view_of());
    const std::vector<SpawnFinding<2>> sized = find_spawn_faults(level.view_of(), spawns, {Character{0.4f, 0.8f}});
    ASSERT_EQ(sized.size(), 2u);
    EXPECT_NEAR(sized[0].depth, 0.2, 1e-5);
    EXPECT_NEAR(sized[1].depth, 0.65, 1e-5);
    ASSERT_TRUE(sized[1].free);
    EXPECT_NEAR(sized[1].free->y, -0.4, 0.01);
    EXPECT_EQ(find_spawn_faults(level.view_of(), spawns, {}).size(), 1u);
}

}  // namespace
}  // namespace abut::tool
