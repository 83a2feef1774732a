// The calls to a progress bar during the work.

#include "scene_of.hpp"
#include "tool/cast/cast.hpp"
#include "tool/check/check.hpp"
#include "tool/objects/scene_objects.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut::tool {
namespace {

/// "1/3 2/3 3/3"
struct Recorded {
    std::string all;

    void operator()(std::size_t done, std::size_t of) {
        all += (all.empty() ? "" : " ") + std::to_string(done) + "/" + std::to_string(of);
    }
};

/// Two boxes, the faces 3 apart.
Scene two_boxes() {
    Scene scene;
    test::add_unit_box(scene, "left", {0, 0, 0});
    test::add_unit_box(scene, "right", {4, 0, 0});
    return scene;
}

TEST(Progress, OfPlacingIsInObjects) {
    const Scene scene = two_boxes();
    SceneObjects objects(scene);
    Recorded progress;
    ASSERT_FALSE(objects.go_to(0, progress));
    EXPECT_EQ(progress.all, "1/2 2/2");
}

TEST(Progress, OfACheckIsInFrames) {
    const Scene scene = two_boxes();
    SceneObjects objects(scene);
    ASSERT_FALSE(objects.go_to(0));
    Recorded progress;
    ASSERT_TRUE(check(objects, {0, 1, 2}, {}, progress));
    EXPECT_EQ(progress.all, "1/3 2/3 3/3");
}

TEST(Progress, OfACastIsInHits) {
    const Scene scene = two_boxes();
    SceneObjects objects(scene);
    ASSERT_FALSE(objects.go_to(0));
    Recorded progress;
    cast(objects, {.from = {1, 0, 0}, .to = {2, 0, 0}, .bounces = 2}, progress);
    EXPECT_EQ(progress.all, "1/3 2/3 3/3");
}

}  // namespace
}  // namespace abut::tool
