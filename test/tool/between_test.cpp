// Contacts between two frames.

#include "scene_of.hpp"
#include "tool/check/check.hpp"
#include "tool/objects/scene_objects.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace abut::tool {
namespace {

CheckResult<3> check_at(const Scene& scene, const std::vector<double>& times, const CheckOptions& options = {}) {
    SceneObjects objects(scene);
    EXPECT_FALSE(objects.go_to(times.front()));
    Result<CheckResult<3>> result = check<3>(objects, times, options, [](std::size_t, std::size_t) {});
    EXPECT_TRUE(result);
    return *std::move(result);
}
CheckResult<3> check_between_keys(const Scene& scene, const CheckOptions& options = {}) {
    return check_at(scene, key_times(scene), options);
}

using Keys = std::vector<std::pair<double, glm::dvec3>>;

KeyTrack<glm::dvec3>& add_motion(Scene& scene, std::uint32_t node, const Keys& keys,
                                 Interpolation interpolation = Interpolation::linear) {
    Animation animation;
    animation.length = keys.back().first;
    animation.motions.resize(1);
    animation.motions[0].node = node;
    KeyTrack<glm::dvec3>& track = animation.motions[0].translation;
    track.interpolation = interpolation;
    for (const auto& [time, place] : keys) {
        track.times.push_back(time);
        track.values.push_back(place);
        if (interpolation == Interpolation::cubic) {
            track.in_tangents.emplace_back(0);
            track.out_tangents.emplace_back(0);
        }
    }
    scene.animations.push_back(std::move(animation));
    schedule(scene);
    return scene.animations.back().motions[0].translation;
}

/// A box of edges of length 1 that goes from key to key, and a wall across x = 0.
Scene walker_and_wall(const Keys& keys, Interpolation interpolation = Interpolation::linear) {
    Scene scene;
    test::add_object(scene, "Wall", test::box_triangles({0.0005f, 5, 5}));
    add_motion(scene, test::add_unit_box(scene, "Walker", keys.front().second), keys, interpolation);
    return scene;
}

// Two keys, a train at either side of a house: `check` reported CLEAN.
TEST(Between, AThingIsMetThatIsPassedThrough) {
    Scene scene;
    test::add_unit_box(scene, "House", {0, 0, 0});
    add_motion(scene, test::add_unit_box(scene, "Train", {-10, 0, 0}), {{0, {-10, 0, 0}}, {5, {10, 0, 0}}});
    const CheckResult<3> result = check_between_keys(scene);
    ASSERT_EQ(result.findings.size(), 1u);
    const ContactFinding<3>& finding = result.findings[0];
    EXPECT_TRUE(finding.between);
    EXPECT_EQ(finding.first, 0u);
    EXPECT_EQ(finding.last, 0u);
    EXPECT_NEAR(finding.time, 2.25, 1e-5);
    EXPECT_LT(finding.distance, -0.5f) << "near its deepest";
    EXPECT_GE(finding.distance, -1.0f);
    EXPECT_GT(finding.deepest_time, 2.25);
    EXPECT_LE(finding.deepest_time, finding.last_time);
    EXPECT_LE(finding.last_time, 2.75);
    EXPECT_EQ(result.tested, 0u);
    EXPECT_EQ(result.swept, 1u);
}

TEST(Between, HoweverThinAndFast) {
    for (const double speed : {10.0, 1e3, 1e5}) {
        const CheckResult<3> result =
            check_between_keys(walker_and_wall({{0, {-speed, 0, 0}}, {1, {-speed, 0, 0.25}}, {2, {speed, 0, 0}}}));
        ASSERT_EQ(result.findings.size(), 1u) << speed;
        EXPECT_EQ(result.findings[0].first, 1u);
        EXPECT_NEAR(result.findings[0].time, 1 + 0.5 * (speed - 0.5005) / speed, 1e-5);
    }
}

TEST(Between, WhatIsFoundAtAFrameIsReportedOnce) {
    // In the wall at the second of three frames; beside it at the others.
    const CheckResult<3> result =
        check_between_keys(walker_and_wall({{0, {-5, 0, 0}}, {1, {0.25, 0, 0}}, {2, {5, 0, 0}}}));
    ASSERT_EQ(result.findings.size(), 1u);
    EXPECT_FALSE(result.findings[0].between);
    EXPECT_EQ(result.findings[0].first, 1u);
}

TEST(Between, ThingsMaySlideAndRestOnThings) {
    for (const double depth : {-1e-4, 0.0, 3e-4, 8e-4}) {  // allowed is 1e-3 of the box's size, 8.7e-4
        Scene scene;
        test::add_object(scene, "Floor", test::box_triangles({50, 1, 50}),
                         glm::translate(glm::dmat4(1.0), glm::dvec3(0, -1, 0)));
        const double y = 0.5 - depth;
        add_motion(scene, test::add_unit_box(scene, "Crate", {-20, y, 0}), {{0, {-20, y, 0}}, {1, {20, y, 7}}});
        EXPECT_TRUE(check_between_keys(scene).findings.empty()) << depth;
        // A bump between two keys is one.
        test::add_unit_box(scene, "Bump", {0, -0.49, 3.5});
        EXPECT_EQ(check_between_keys(scene).findings.size(), 2u) << depth << ": the bump is in the floor, and met";
        EXPECT_EQ(check_between_keys(scene, {.limits = {.allow = 0.02f}, .pairs = {{"Bump", "Crate"}}}).findings.size(),
                  0u);
    }
}

TEST(Between, WheelsOnRailsAreFine) {
    // A wheel of 32 corners that rolls on a rail by 11.25 degrees per key, from side to side.
    constexpr int corners = 32;
    const double angle = 2 * 3.14159265358979 / corners, inner = std::cos(angle / 2);
    test::Triangles wheel;
    for (int i = 0; i < 2 * corners; ++i) {
        const double turn = angle * (i / 2 + 0.5);
        wheel.points.emplace_back(std::sin(turn), -std::cos(turn), i % 2 == 0 ? -0.1 : 0.1);
    }
    for (std::uint32_t i = 0; i < corners; ++i) {
        const std::uint32_t a = 2 * i, b = (2 * i + 2) % (2 * corners);
        wheel.triangles.emplace_back(a, a + 1, b + 1);
        wheel.triangles.emplace_back(a, b + 1, b);
        if (i > 0 && i + 1 < corners) {
            wheel.triangles.emplace_back(0, a, b);
            wheel.triangles.emplace_back(1, b + 1, a + 1);
        }
    }
    Scene scene;
    test::add_object(scene, "Rail", test::box_triangles({20, 0.5f, 0.05f}),
                     glm::translate(glm::dmat4(1.0), glm::dvec3(0, -0.5, 0)));
    const std::uint32_t node = test::add_object(scene, "Wheel", wheel);
    Animation animation;
    animation.motions.resize(1);
    animation.motions[0].node = node;
    for (int i = 0; i <= 8; ++i) {
        animation.motions[0].translation.times.push_back(i);
        animation.motions[0].translation.values.emplace_back(i * angle, inner, 0);
        animation.motions[0].rotation.times.push_back(i);
        animation.motions[0].rotation.values.push_back(glm::angleAxis(-i * angle, glm::dvec3(0, 0, 1)));
    }
    animation.length = 8;
    scene.animations.push_back(animation);
    schedule(scene);
    // A corner goes below the rail by 1 - cos(5.6 degrees) of the radius between two keys: more than --allow permits.
    const float bump = static_cast<float>(1 - inner);
    EXPECT_TRUE(check_between_keys(scene, {.limits = {.allow = 1.1f * bump}}).findings.empty());
    const CheckResult<3> result = check_between_keys(scene, {.limits = {.allow = 0.5f * bump}});
    ASSERT_EQ(result.findings.size(), 8u) << "one for each gap between frames";
    for (const ContactFinding<3>& finding : result.findings) EXPECT_NEAR(finding.distance, -bump, 0.2f * bump);
}

TEST(Between, ABarMeetsAPostAsItTurns) {
    // Half a turn from one frame to the other; the post is beside the bar at both.
    for (const char* name : {"A bar", "The bar"}) {
        Scene scene;
        test::add_object(scene, "Post", test::box_triangles({0.1f, 1, 0.1f}),
                         glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 1.5)));
        Animation animation;
        animation.motions.resize(1);
        animation.motions[0].node = test::add_object(scene, name, test::box_triangles({2, 0.1f, 0.1f}));
        for (const double time : {0.0, 0.5, 1.0}) {
            animation.motions[0].rotation.times.push_back(time);
            animation.motions[0].rotation.values.push_back(
                glm::angleAxis(3.14159265358979 * time, glm::dvec3(0, 1, 0)));
        }
        animation.length = 1;
        scene.animations.push_back(animation);
        schedule(scene);
        const CheckResult<3> result = check_at(scene, {0, 1});
        ASSERT_EQ(result.findings.size(), 1u) << name;
        EXPECT_TRUE(result.findings[0].between);
        EXPECT_NEAR(result.findings[0].deepest_time, 0.5, 0.1);
    }
}

TEST(Between, StepsJump) {
    const Keys keys{{0, {-5, 0, 0}}, {1, {5, 0, 0}}, {2, {-5, 0, 0}}};
    EXPECT_EQ(check_between_keys(walker_and_wall(keys)).findings.size(), 2u);
    EXPECT_TRUE(check_between_keys(walker_and_wall(keys, Interpolation::step)).findings.empty());
    EXPECT_TRUE(check_at(walker_and_wall(keys, Interpolation::step), {0, 0.3, 1.7, 2}).findings.empty());
    // Two keys at one time are a step too.
    EXPECT_TRUE(check_between_keys(walker_and_wall({{0, {-5, 0, 0}}, {1, {-4, 0, 0}}, {1, {4, 0, 0}}, {2, {5, 0, 0}}}))
                    .findings.empty());
}

TEST(Between, WhatLeapsWithinOneFrameJumps) {
    const auto walk = [](double leap) {
        Keys keys;
        double x = -1;
        for (int i = 0; i <= 48; ++i) {
            keys.emplace_back(i / 24.0, glm::dvec3(x, 0, 0));
            x += i == 24 ? leap : 0.005;
        }
        return keys;
    };
    EXPECT_TRUE(check_between_keys(walker_and_wall(walk(4))).findings.empty());
    // A constant high speed is fast, and sampled all the same.
    Keys fast;
    for (int i = 0; i <= 48; ++i) fast.emplace_back(i / 24.0, glm::dvec3(-98 + 4 * i, 0, 0));
    EXPECT_EQ(check_between_keys(walker_and_wall(fast)).findings.size(), 1u);
    // So is an animation that is as short as that.
    EXPECT_EQ(check_between_keys(walker_and_wall({{0, {-3, 0, 0}}, {1 / 24.0, {3, 0, 0}}})).findings.size(), 1u);
}

TEST(Between, TheNextClipBeginsWhereItBegins) {
    Scene scene = walker_and_wall({{0, {-5, 0, 0}}, {1, {-3, 0, 0}}});
    add_motion(scene, 1, {{0, {5, 0, 0}}, {1, {3, 0, 0}}});
    EXPECT_GT(scene.animations[1].start, 1.0);
    EXPECT_TRUE(check_between_keys(scene).findings.empty());
    EXPECT_TRUE(check_at(scene, {0, 2}).findings.empty());
    add_motion(scene, 1, {{0, {5, 0, 0}}, {1, {-3, 0, 0}}});
    const CheckResult<3> result = check_at(scene, {0, 2, 4});
    ASSERT_EQ(result.findings.size(), 1u);
    EXPECT_EQ(result.findings[0].first, 1u);
    EXPECT_NEAR(result.findings[0].time, scene.animations[2].start + (5 - 0.5005) / 8, 1e-4);
}

TEST(Between, KeysBetweenFramesAreFollowed) {
    // Around the wall, which ends at y = 5.
    const Keys around{{0, {-3, 0, 0}}, {1, {-3, 7, 0}}, {2, {3, 7, 0}}, {3, {3, 0, 0}}};
    EXPECT_TRUE(check_at(walker_and_wall(around), {0, 3}).findings.empty());
    const Keys through{{0, {-3, 7, 0}}, {1, {-3, 0, 0}}, {2, {3, 0, 0}}, {3, {3, 7, 0}}};
    const CheckResult<3> result = check_at(walker_and_wall(through), {0, 3});
    ASSERT_EQ(result.findings.size(), 1u);
    EXPECT_NEAR(result.findings[0].time, 1 + 2.4995 / 6, 1e-5);
}

TEST(Between, SplinesAreFollowed) {
    // Out through the wall and back to the start, in one piece of a spline: the ends don't show it.
    Scene scene = walker_and_wall({{0, {-2, 0, 0}}, {1, {-2, 0, 0}}}, Interpolation::cubic);
    KeyTrack<glm::dvec3>& track = scene.animations[0].motions[0].translation;
    track.out_tangents[0] = {16, 0, 0};
    track.in_tangents[1] = {-16, 0, 0};  // x = -2 + 16 t (1 - t), 2 at most
    const CheckResult<3> result = check_between_keys(scene);
    ASSERT_EQ(result.findings.size(), 1u);
    const double x = -0.5005, t = 0.5 - std::sqrt(0.25 - (x + 2) / 16);
    EXPECT_NEAR(result.findings[0].time, t, 2e-3);
    track.out_tangents[0] = {5, 0, 0};
    track.in_tangents[1] = {-5, 0, 0};  // to -0.75
    EXPECT_TRUE(check_between_keys(scene).findings.empty());
}

TEST(Between, TurnsAreFollowedAroundTheirAxis) {
    // A box on an arm of 10 that turns by a quarter, in one step from key to key.
    const auto with = [](const glm::dvec3& pillar) {
        Scene scene;
        SceneNode arm;
        arm.name = "Arm";
        scene.nodes.push_back(arm);
        const std::uint32_t box = test::add_unit_box(scene, "Box", {10, 0, 0});
        scene.nodes[box].parent = 0;
        test::add_unit_box(scene, "Pillar", pillar);
        Animation animation;
        animation.length = 1;
        animation.motions.resize(1);
        animation.motions[0].rotation.times = {0, 1};
        animation.motions[0].rotation.values = {glm::dquat(1, 0, 0, 0),
                                                glm::angleAxis(0.5 * 3.14159265358979, glm::dvec3(0, 0, 1))};
        scene.animations.push_back(animation);
        schedule(scene);
        return scene;
    };
    EXPECT_EQ(check_between_keys(with({7.07, 7.07, 0})).findings.size(), 1u) << "on the arc";
    EXPECT_TRUE(check_between_keys(with({5, 5, 0})).findings.empty()) << "on the chord";
}

TEST(Between, WhatChangesItsShapeIsTestedAtFrames) {
    Scene scene = walker_and_wall({{0, {-5, 0, 0}}, {1, {5, 0, 0}}});
    KeyTrack<glm::dvec3>& scale = scene.animations[0].motions[0].scale;
    scale.times = {0, 1};
    scale.values = {{1, 1, 1}, {2, 1, 1}};
    SceneObjects objects(scene);
    ASSERT_FALSE(objects.go_to(0));
    const auto result = check<3>(objects, {0, 1}, {}, [](std::size_t, std::size_t) {});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->findings.empty());
    EXPECT_EQ(objects.discontinuous(), std::vector<std::string>{"Walker"});
}

TEST(Between, ClearanceHoldsBetweenFramesToo) {
    Scene scene = walker_and_wall({{0, {-5, 5.75, 0}}, {1, {5, 5.75, 0}}});  // 0.25 above the wall's end
    EXPECT_TRUE(check_between_keys(scene).findings.empty());
    EXPECT_TRUE(check_between_keys(scene, {.limits = {.clearance = 0.2f}}).findings.empty());
    const CheckResult<3> result = check_between_keys(scene, {.limits = {.clearance = 0.3f}});
    ASSERT_EQ(result.findings.size(), 1u);
    EXPECT_NEAR(result.findings[0].distance, 0.25f, 1e-5f);
}

TEST(Between, MeshesTooAndOnesThatMoveTogetherAreLeftAlone) {
    Scene scene;
    test::add_object(scene, "Corner", test::corner_triangles(1));
    const std::uint32_t train = test::add_object(scene, "Train", test::corner_triangles(1));
    const std::uint32_t load = test::add_unit_box(scene, "Load", {0.9, 0.9, 0});  // 0.1 in it
    scene.nodes[load].parent = train;
    add_motion(scene, train, {{0, {-9, 0.3, 0.2}}, {3, {9, 0.3, 0.2}}});
    const CheckResult<3> result = check_between_keys(scene);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const ContactFinding<3>& finding : result.findings)
        if (finding.between) pairs.emplace_back(finding.a, finding.b);
    EXPECT_EQ(pairs, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 1}, {0, 2}}));
    EXPECT_EQ(result.findings.size(), 3u) << "and the load in the train, all the time";
}

// 3,000 boxes at one place once took 5 GB, to report 4,498,500 pairs.
TEST(ContactFindings, OfMoreThanWantedTheDeepestAreGiven) {
    Scene scene;
    for (int i = 0; i < 60; ++i) test::add_unit_box(scene, "Box " + std::to_string(100 + i), {0.01 * i, 0, 0});
    add_motion(scene, 59, {{0, {0.59, 0, 0}}, {1, {0.59, 0.001, 0}}, {2, {0, 0, 0}}});
    CheckResult<3> all = check_between_keys(scene);
    ASSERT_EQ(all.findings.size(), 60u * 59u / 2u);
    EXPECT_EQ(all.left_out, 0u);
    const CheckResult<3> some = check_between_keys(scene, {.limits = {}, .pairs = {}, .max_findings = 7});
    EXPECT_EQ(some.left_out, all.findings.size() - 7);
    ASSERT_EQ(some.findings.size(), 7u);
    std::sort(all.findings.begin(), all.findings.end(), [](const ContactFinding<3>& x, const ContactFinding<3>& y) {
        return std::tuple(x.distance, x.a, x.b) < std::tuple(y.distance, y.a, y.b);
    });
    all.findings.resize(7);
    std::sort(all.findings.begin(), all.findings.end(), [](const ContactFinding<3>& x, const ContactFinding<3>& y) {
        return std::tie(x.a, x.b) < std::tie(y.a, y.b);
    });
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(some.findings[i].a, all.findings[i].a);
        EXPECT_EQ(some.findings[i].b, all.findings[i].b);
        EXPECT_EQ(some.findings[i].distance, all.findings[i].distance);
        EXPECT_EQ(some.findings[i].first, all.findings[i].first);
        EXPECT_EQ(some.findings[i].last, all.findings[i].last);
        EXPECT_EQ(some.findings[i].points, all.findings[i].points);
    }
}

TEST(NearPairs, TooManyAreAProblem) {
    const std::vector<Aabb3> boxes(5, Aabb3{{0, 0, 0}, {1, 1, 1}});
    struct Thing {
        std::string path, name, type;
    };
    const std::vector<Thing> things(5);
    const PairFilter all(things, {});
    const Scene nothing;
    const SceneObjects no_objects(nothing);
    const Limits limits{};
    const Piles<3> no_piles(no_objects, limits, all);
    OverlappingPairs<3> enough(all, 10), few(all, 9);
    EXPECT_FALSE(enough.find(boxes, no_piles));
    EXPECT_EQ(enough.pairs().size(), 10u);
    const std::optional<Problem> problem = few.find(boxes, no_piles);
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->message, "more than 9 pairs of objects overlap, the limit: --pairs selects fewer");
}

}  // namespace
}  // namespace abut::tool
