#include "tool/faults/walkable.hpp"

#include "level_of.hpp"
#include "tool/faults/faults.hpp"

#include <gtest/gtest.h>

namespace abut::tool {
namespace {

constexpr Character walker{0.3f, 1.8f};

std::vector<Gap<3>> gaps_for(Scene scene, std::vector<std::string>* notes = nullptr) {
    const test::SpaceLevel level(std::move(scene));
    FaultOptions options;
    options.character = walker;
    const Result<LevelFaults<3>> faults = find_faults(level.view_of(), options, Severities());
    EXPECT_TRUE(faults);
    if (notes != nullptr) *notes = faults->notes;
    return faults->gaps;
}

Scene floor_with_spawn() {
    Scene scene;
    test::add_box(scene, "Floor", {-9, -1, -9}, {9, 0, 9});
    test::add_place(scene, "Spawn", {-5, 0, 0});
    return scene;
}

TEST(Walkable, ADoorThatIsTooNarrowIsReported) {
    Scene scene = floor_with_spawn();
    test::add_box(scene, "North", {0, 0, -9}, {0.3, 3, -0.25});
    test::add_box(scene, "South", {0, 0, 0.25}, {0.3, 3, 9});
    const std::vector<Gap<3>> gaps = gaps_for(scene);
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_NEAR(gaps[0].width, 0.5, 1e-5);
}

TEST(Walkable, NothingUnderAChair) {
    Scene scene = floor_with_spawn();
    for (const double x : {0.0, 0.45})
        for (const double z : {0.0, 0.45})
            test::add_box(scene, "Leg " + std::to_string(x) + std::to_string(z), {x, 0, z}, {x + 0.05, 0.45, z + 0.05});
    test::add_box(scene, "Seat", {0, 0.45, 0}, {0.5, 0.5, 0.5});
    EXPECT_TRUE(gaps_for(scene).empty());
    // Everything counts if nobody is there to walk.
    scene.nodes[1].name = "Here";
    std::vector<std::string> notes;
    EXPECT_FALSE(gaps_for(scene, &notes).empty());
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0], "there is no spawn: gaps are reported everywhere, also where nobody walks");
}

TEST(Walkable, NothingInAClosedRoom) {
    Scene scene = floor_with_spawn();
    // A hut of four walls and a roof, with two pillars in it.
    test::add_box(scene, "West", {0, 0, -2}, {0.2, 3, 2});
    test::add_box(scene, "East", {4, 0, -2}, {4.2, 3, 2});
    test::add_box(scene, "North", {0.2, 0, -2}, {4, 3, -1.8});
    test::add_box(scene, "South", {0.2, 0, 1.8}, {4, 3, 2});
    test::add_box(scene, "Roof", {0, 3, -2}, {4.2, 3.2, 2});
    test::add_box(scene, "Pillar", {1.5, 0, -0.2}, {1.7, 2, 0.2});
    test::add_box(scene, "Pillar 2", {2.1, 0, -0.2}, {2.3, 2, 0.2});
    EXPECT_TRUE(gaps_for(scene).empty());
    test::add_place(scene, "Spawn inside", {3, 0, 0});
    EXPECT_EQ(gaps_for(scene).size(), 1u);
}

TEST(Walkable, StepsAreClimbedAndWallsAreNot) {
    for (const double height : {0.3, 0.9}) {
        Scene scene = floor_with_spawn();
        test::add_box(scene, "Stage", {0, 0, -9}, {9, height, 9});
        test::add_box(scene, "Pillar", {4, height, -2}, {4.2, height + 3, -0.25});
        test::add_box(scene, "Pillar 2", {4, height, 0.25}, {4.2, height + 3, 2});
        EXPECT_EQ(gaps_for(scene).size(), height < 0.45 ? 1u : 0u) << height;
    }
}

TEST(Walkable, ACharacterFallsButDoesntClimbBack) {
    Scene scene;
    test::add_box(scene, "Roof", {-9, 4, -9}, {0, 5, 9});
    test::add_box(scene, "Yard", {0, -1, -9}, {9, 0, 9});
    test::add_place(scene, "Spawn", {-5, 5, 0});
    const test::SpaceLevel level(scene);
    const FacetTree<3> facets(level.view_of().objects);
    const std::vector<Vec3> on_roof{{-5, 5, 0}}, in_yard{{5, 0, 0}};
    const Walkable<3> down(facets, walker, Vec3(0, 1, 0), on_roof), up(facets, walker, Vec3(0, 1, 0), in_yard);
    EXPECT_TRUE(down.reaches({5, 1, 0}, 0.3));
    EXPECT_TRUE(down.reaches({-5, 6, 0}, 0.3));
    EXPECT_TRUE(up.reaches({5, 1, 0}, 0.3));
    EXPECT_FALSE(up.reaches({-5, 6, 0}, 0.3));
    EXPECT_FALSE(down.reaches({20, 1, 0}, 0.3)) << "nobody walks on nothing";
}

TEST(Walkable, InThePlane) {
    test::PlaneLevel level;
    level.add_box("west", {-5, -5}, {-4, 5});
    level.add_box("east", {4, -5}, {5, 5});
    level.add_box("south", {-4, -5}, {4, -4});
    level.add_box("north", {-4, 4}, {4, 5});
    level.add_box("wall", {0, -4}, {0.5f, 3.5f});
    const FacetTree<2> facets(level.view_of().objects);
    const std::vector<Vec2> spawn{{-2, 0}};
    const Walkable<2> wide(facets, {0.4f, 0.8f}, std::nullopt, spawn), thin(facets, {0.2f, 0.4f}, std::nullopt, spawn);
    for (const Walkable<2>* one : {&wide, &thin}) {
        EXPECT_TRUE(one->is_complete());
        EXPECT_TRUE(one->reaches({-3, -3}, 0.1));
        EXPECT_FALSE(one->reaches({9, 0}, 0.1));
    }
    EXPECT_FALSE(wide.reaches({3, -3}, 0.1));
    EXPECT_TRUE(thin.reaches({3, -3}, 0.1));
}

// Seen from the side, or without walls around: a million places were visited outside, and then all of them counted.
TEST(Walkable, NotFarOutsideOfALevelInThePlane) {
    test::PlaneLevel level;
    level.add_box("ground", {-20, 0}, {20, 2});
    const FacetTree<2> facets(level.view_of().objects);
    const std::vector<Vec2> spawn{{0, -1}};
    const Walkable<2> walkable(facets, {0.4f, 0.8f}, std::nullopt, spawn);
    EXPECT_TRUE(walkable.is_complete());
    EXPECT_LT(walkable.size(), 2000u);
    EXPECT_TRUE(walkable.reaches({-10, -0.5}, 0.1));
    EXPECT_TRUE(walkable.reaches({10, 2.5}, 0.1)) << "around the end";
}

}  // namespace
}  // namespace abut::tool
