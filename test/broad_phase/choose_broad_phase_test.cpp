// Which broad phase is chosen for whom. That the choice is a quick one, the bench tells.

#include "../../scenes/moving_boxes.hpp"
#include "../../scenes/skewed_boxes.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/chosen_broad_phase.hpp>

#include <algorithm>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Ten heaps of small boxes, so far apart that the cells of one grid either hold a whole heap or are too many.
template <int D>
std::vector<Aabb<D>> heaps(std::uint32_t count) {
    oracle::Random random(51);
    std::vector<Aabb<D>> result;
    for (std::uint32_t i = 0; i < count; ++i) {
        const DVec<D> heap = DVec<D>(1e4 * (i % 10)), place = random.in_cube<D>() * (D == 2 ? 60.0 : 20.0);
        result.push_back(box_at<D>(heap + place, DVec<D>(0.5)));
    }
    return result;
}

template <class T>
class Choices : public testing::Test {};
using Dimensions = testing::Types<ChosenBroadPhase<2>, ChosenBroadPhase<3>>;
TYPED_TEST_SUITE(Choices, Dimensions);

template <int D>
BroadPhaseKind choice(std::span<const Aabb<D>> boxes, const BroadPhaseHistory& history = {}) {
    return choose_broad_phase<D>(boxes, history);
}

TYPED_TEST(Choices, FollowTheScene) {
    constexpr int D = dimension_of<TypeParam>;
    const scenes::MovingBoxes<D> few(50, 1), many(20000, 1);
    const scenes::SkewedBoxes<D> skewed(20000, 1);
    EXPECT_EQ(choice<D>({}), BroadPhaseKind::brute_force);
    EXPECT_EQ(choice<D>(few.boxes()), BroadPhaseKind::brute_force);
    EXPECT_EQ(choice<D>(many.boxes()), BroadPhaseKind::grid);
    EXPECT_EQ(choice<D>(skewed.boxes()), BroadPhaseKind::grid);
    EXPECT_EQ(choice<D>(many.boxes(), {.asked = 0.1}), BroadPhaseKind::bvh);
    EXPECT_EQ(choice<D>(heaps<D>(20000)), BroadPhaseKind::bvh);
    const std::vector<Aabb<D>> empty(500, Aabb<D>::empty());
    EXPECT_EQ(choice<D>(empty), BroadPhaseKind::grid);
}

/// A scene that changes its nature, the right pairs all the time.
TYPED_TEST(Choices, ChangeWithTheScene) {
    constexpr int D = dimension_of<TypeParam>;
    scenes::MovingBoxes<D> scene(2000, 3);
    TypeParam phase;
    phase.build(scene.boxes());
    EXPECT_EQ(phase.kind(), BroadPhaseKind::grid);
    BruteForce<D> oracle;
    std::vector<ItemPair> expected, found;
    for (int frame = 1; frame <= 200; ++frame) {
        scene.step();
        if (frame == 80) phase.tell({.asked = 1});
        phase.update(scene.boxes());
        EXPECT_EQ(phase.kind(), frame < 128 ? BroadPhaseKind::grid : BroadPhaseKind::bvh) << frame;
        if (frame % 32 != 0) continue;
        oracle.build(scene.boxes());
        oracle.sorted_pairs(expected);
        phase.sorted_pairs(found);
        EXPECT_EQ(found, expected) << frame;
        EXPECT_GT(expected.size(), 500u);
    }
    const auto far = heaps<D>(2000);
    phase.update(far);
    EXPECT_EQ(phase.size(), far.size());
    phase.build({});
    EXPECT_EQ(phase.kind(), BroadPhaseKind::brute_force);
    EXPECT_TRUE(phase.empty());
}

}  // namespace
}  // namespace abut::test
