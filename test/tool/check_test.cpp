#include "tool/check/check.hpp"

#include "scene_of.hpp"
#include "tool/objects/scene_objects.hpp"

#include <gtest/gtest.h>

namespace abut::tool {
namespace {

CheckResult<3> check_scene(const Scene& scene, const CheckOptions& options = {}) {
    SceneObjects objects(scene);
    const std::vector<double> times = key_times(scene);
    EXPECT_FALSE(objects.go_to(times.front()));
    Result<CheckResult<3>> result = check<3>(objects, times, options, [](std::size_t, std::size_t) {});
    EXPECT_TRUE(result);
    return *std::move(result);
}

TEST(Check, ReportsKnownDistances) {
    Scene scene;
    test::add_unit_box(scene, "a", {0, 0, 0});
    test::add_unit_box(scene, "b", {0.75, 0, 0});
    test::add_unit_box(scene, "c", {5, 0, 0});
    const CheckResult<3> result = check_scene(scene);
    ASSERT_EQ(result.findings.size(), 1u);
    const ContactFinding<3>& finding = result.findings[0];
    EXPECT_EQ(finding.a, 0u);
    EXPECT_EQ(finding.b, 1u);
    EXPECT_FLOAT_EQ(finding.distance, -0.25f);
    EXPECT_EQ(finding.normal, Vec3(1, 0, 0));
    ASSERT_EQ(finding.points.size(), 4u);
    for (const Vec3& point : finding.points) EXPECT_FLOAT_EQ(point.x, 0.375f);
    EXPECT_EQ(result.tested, 1u);
    EXPECT_EQ(result.possible, 3u);
}

TEST(Check, ThingsMayRestOnThings) {
    Scene scene;
    test::add_unit_box(scene, "a", {0, 0, 0});
    test::add_unit_box(scene, "b", {1, 0, 0});
    test::add_unit_box(scene, "c", {0, 0.9995, 0});  // the size of these boxes is 0.87
    EXPECT_TRUE(check_scene(scene).findings.empty());
    EXPECT_EQ(check_scene(scene, {.limits = {.allow = 1e-4f}}).findings.size(), 1u);
    scene.nodes[2].local[3][1] = 0.998;
    EXPECT_EQ(check_scene(scene).findings.size(), 1u);
    EXPECT_TRUE(check_scene(scene, {.limits = {.allow = 0.01f}}).findings.empty());
}

TEST(Check, ClearanceFindsGapsButNotWhatRests) {
    Scene scene;
    test::add_unit_box(scene, "a", {0, 0, 0});
    test::add_unit_box(scene, "b", {1.25, 0, 0});
    test::add_unit_box(scene, "c", {0, 1, 0});
    EXPECT_TRUE(check_scene(scene).findings.empty());
    EXPECT_TRUE(check_scene(scene, {.limits = {.clearance = 0.2f}}).findings.empty());
    const CheckResult<3> result = check_scene(scene, {.limits = {.clearance = 0.3f}});
    ASSERT_EQ(result.findings.size(), 2u) << "a and b, and across the corner b and c";
    EXPECT_FLOAT_EQ(result.findings[0].distance, 0.25f);
    EXPECT_FLOAT_EQ(result.findings[1].distance, 0.25f);
}

TEST(Check, OneFindingForEachUnbrokenInterval) {
    Scene scene;
    test::add_unit_box(scene, "door", {0, 0, 0});
    const std::uint32_t walker = test::add_unit_box(scene, "walker", {0, 0, 0});
    // In, deeper, out, out at the other side, in again until the end.
    test::add_slide(scene, walker, {-3, -0.9, -0.5, -3, 3, 0.75, 0.8});
    const CheckResult<3> result = check_scene(scene);
    ASSERT_EQ(result.findings.size(), 3u);
    EXPECT_EQ(result.findings[0].first, 1u);
    EXPECT_EQ(result.findings[0].last, 2u);
    EXPECT_EQ(result.findings[0].deepest, 2u);
    EXPECT_FLOAT_EQ(result.findings[0].distance, -0.5f);
    EXPECT_TRUE(result.findings[1].between);
    EXPECT_EQ(result.findings[1].first, 3u);
    EXPECT_NEAR(result.findings[1].time, 3 + 2.0 / 6, 1e-5);
    EXPECT_EQ(result.findings[2].first, 5u);
    EXPECT_EQ(result.findings[2].last, 6u);
    EXPECT_EQ(result.findings[2].deepest, 5u);
    EXPECT_FLOAT_EQ(result.findings[2].distance, -0.25f);
    EXPECT_EQ(result.possible, 7u);
}

TEST(Check, WhatStandsStillIsTestedOnce) {
    Scene scene;
    test::add_unit_box(scene, "a", {0, 0, 0});
    test::add_unit_box(scene, "b", {0.5, 0, 0});
    test::add_unit_box(scene, "c", {0.5, 0.5, 0});
    const std::uint32_t walker = test::add_unit_box(scene, "walker", {0, 0, 0});
    test::add_slide(scene, walker, {9, 8, 7, 7, 7, 0.25});
    const CheckResult<3> result = check_scene(scene);
    EXPECT_EQ(result.tested, 3u + 3u);
    ASSERT_EQ(result.findings.size(), 6u);
    EXPECT_EQ(result.findings[0].first, 0u);
    EXPECT_EQ(result.findings[0].last, 5u) << "carried on while neither moves";
}

TEST(Check, AShapeThatGoesEndsItsFindings) {
    Scene scene;
    test::add_unit_box(scene, "a", {0, 0, 0});
    const std::uint32_t coin = test::add_unit_box(scene, "coin", {0.5, 0, 0});
    Animation animation;
    animation.length = 3;
    animation.motions.resize(1);
    animation.motions[0].node = coin;
    animation.motions[0].scale.times = {0, 1, 2, 3};
    animation.motions[0].scale.values = {{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, {1, 1, 1}};
    scene.animations.push_back(animation);
    schedule(scene);
    const CheckResult<3> result = check_scene(scene);
    ASSERT_EQ(result.findings.size(), 2u);
    EXPECT_EQ(result.findings[0].last, 0u);
    EXPECT_EQ(result.findings[1].first, 3u);
}

TEST(Check, OnlyTheRequestedPairs) {
    Scene scene;
    for (const char* name : {"Player", "Wall 1", "Wall 2", "Crate"}) test::add_unit_box(scene, name, {0, 0, 0});
    EXPECT_EQ(check_scene(scene).findings.size(), 6u);
    const CheckResult<3> result = check_scene(scene, {.limits = {}, .pairs = {{"Wall*", "Player"}}});
    EXPECT_EQ(result.findings.size(), 2u);
    EXPECT_EQ(result.tested, 2u);
    EXPECT_EQ(result.possible, 2u);
    EXPECT_EQ(check_scene(scene, {.limits = {}, .pairs = {{"Wall*", "Player"}, {"Crate", "Player"}}}).findings.size(),
              3u);
    EXPECT_EQ(check_scene(scene, {.limits = {}, .pairs = {{"Wall*", "Wall*"}}}).findings.size(), 1u);
}

TEST(Check, PatternsAreForPathsAndForNames) {
    Object<3> object;
    object.path = "Level/Walls/North";
    object.name = "North";
    for (const char* pattern : {"North", "N*", "Level/Walls/North", "*/North", "Level*"})
        EXPECT_TRUE(matches_name(pattern, object)) << pattern;
    for (const char* pattern : {"Walls", "Level", "Walls/North", "South"})
        EXPECT_FALSE(matches_name(pattern, object)) << pattern;
}

TEST(Check, ABodyInsideOfAnotherThatIsNotConvex) {
    // A crate within the corner cube of an L whose cubes have edges of length 4: 1.5 under its surface, 0.5 to its own.
    Scene scene;
    test::add_object(scene, "Wall", test::corner_triangles(4));
    test::add_unit_box(scene, "Crate", {-0.5, 0, 0});
    const CheckResult<3> result = check_scene(scene);
    ASSERT_EQ(result.findings.size(), 1u);
    EXPECT_TRUE(result.findings[0].inside);
    EXPECT_FLOAT_EQ(result.findings[0].distance, -2);
    // From the crate to the wall: the wall would have to go to the right.
    EXPECT_EQ(result.findings[0].normal, Vec3(1, 0, 0));

    // In the notch of the L, where there is no wall.
    scene.nodes[1].local[3] = {4, 4, 0, 1};
    EXPECT_TRUE(check_scene(scene).findings.empty());
}

TEST(Check, ThingsInARoomAreNotInsideOfABody) {
    Scene scene;
    test::add_object(scene, "Room", test::inside_out(test::corner_triangles(4)));
    test::add_object(scene, "Sky", test::inside_out(test::box_triangles({50, 50, 50})));
    test::add_unit_box(scene, "Crate", {0, 0, 0});
    EXPECT_TRUE(check_scene(scene).findings.empty());
}

TEST(Check, TheSameMeshPlacedTwice) {
    // The surfaces only touch, but the bodies coincide. None is inside the other without touching its surface.
    Scene scene;
    test::add_object(scene, "Wall", test::corner_triangles(4));
    test::add_object(scene, "Wall copy", test::corner_triangles(4));
    const CheckResult<3> result = check_scene(scene);
    ASSERT_EQ(result.findings.size(), 1u);
    EXPECT_FALSE(result.findings[0].inside);
    EXPECT_FLOAT_EQ(result.findings[0].distance, -4) << "along z";
}

TEST(Check, MeshesThatTouchFaceToFaceAreFine) {
    Scene scene;
    test::add_object(scene, "Wall", test::corner_triangles(4));
    test::add_object(scene, "Next", test::corner_triangles(4), glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 4)));
    test::add_unit_box(scene, "Crate", {4, 2.5, 0});
    EXPECT_TRUE(check_scene(scene).findings.empty());
}

}  // namespace
}  // namespace abut::tool
