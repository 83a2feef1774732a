// The choice of a broad phase. The benchmarks measure its speed.

#include "../../scenes/moving_boxes.hpp"
#include "../../scenes/skewed_boxes.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/chosen_broad_phase.hpp>

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Ten clusters of small boxes, so far apart that a grid has too many cells or a whole cluster in one cell.
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
using ChoiceDimensions = testing::Types<ChosenBroadPhase<2>, ChosenBroadPhase<3>>;
TYPED_TEST_SUITE(Choices, ChoiceDimensions);

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
    EXPECT_EQ(choice<D>(many.boxes(), {.queries = 0.1}), BroadPhaseKind::bvh);
    EXPECT_EQ(choice<D>(few.boxes(), {.queries = 0.1}), BroadPhaseKind::brute_force);
    EXPECT_EQ(choice<D>(few.boxes(), {.queries = 1}), BroadPhaseKind::bvh);
    EXPECT_EQ(choice<D>(heaps<D>(20000)), BroadPhaseKind::bvh);
    const std::vector<Aabb<D>> empty(500, Aabb<D>::empty());
    EXPECT_EQ(choice<D>(empty), BroadPhaseKind::grid);
}

/// The fastest kinds for the scenes of the benchmark, by its table.
TYPED_TEST(Choices, SuitTheScenesOfTheBench) {
    constexpr int D = dimension_of<TypeParam>;
    const auto moving = [](std::size_t count, std::size_t one_in_moves = 1) {
        return scenes::MovingBoxes<D>(count, 1, {.one_in_moves = one_in_moves});
    };
    EXPECT_EQ(choice<D>(moving(60).boxes()), BroadPhaseKind::brute_force);
    EXPECT_EQ(choice<D>(moving(200).boxes()), BroadPhaseKind::grid);
    for (const std::size_t count : {1'000u, 10'000u, 100'000u})
        EXPECT_EQ(choice<D>(moving(count).boxes()), BroadPhaseKind::grid) << count;
    for (const std::size_t count : {10'000u, 100'000u})
        EXPECT_EQ(choice<D>(moving(count, 10).boxes(), {.moved = 0.1}), BroadPhaseKind::grid) << count;
    EXPECT_EQ(choice<D>(scenes::SkewedBoxes<D>(100'000, 1).boxes()), BroadPhaseKind::grid);
    for (const std::size_t count : {100u, 100'000u})
        EXPECT_EQ(choice<D>(moving(count).boxes(), {.moved = 0, .queries = 1}), BroadPhaseKind::bvh) << count;
}

/// A scene that changes its character, with correct pairs at all times.
TYPED_TEST(Choices, ChangeWithTheScene) {
    constexpr int D = dimension_of<TypeParam>;
    scenes::MovingBoxes<D> scene(2000, 3);
    TypeParam phase;
    phase.build(scene.boxes());
    EXPECT_EQ(phase.kind(), BroadPhaseKind::grid);
    BruteForce<D> oracle;
    std::vector<detail::ItemPair> expected, found;
    for (int frame = 1; frame <= 200; ++frame) {
        scene.step();
        if (frame == 80) phase.set_history({.queries = 1});
        phase.update(scene.boxes());
        EXPECT_EQ(phase.kind(), frame < 80 ? BroadPhaseKind::grid : BroadPhaseKind::bvh) << frame;
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

/// With more rays, the choice is reviewed at the next update, not at the next regular review. With about as many rays
/// as before, it waits.
TYPED_TEST(Choices, FollowTheQueriesAtOnceAndAreStable) {
    constexpr int D = dimension_of<TypeParam>;
    const scenes::MovingBoxes<D> scene(500, 3);
    const auto update = [&](TypeParam& phase, double asked) {
        phase.set_history({.queries = asked});
        phase.update(scene.boxes());
        return phase.kind();
    };
    TypeParam phase;
    phase.build(scene.boxes());
    EXPECT_EQ(update(phase, 0), BroadPhaseKind::grid);
    EXPECT_EQ(update(phase, 0.5), BroadPhaseKind::bvh);
    EXPECT_EQ(update(phase, 0.4), BroadPhaseKind::bvh);
    EXPECT_EQ(update(phase, 0), BroadPhaseKind::grid);
    // The number of queries is around the break-even point.
    double often = 1;
    while (choice<D>(scene.boxes(), {.queries = often}) == BroadPhaseKind::bvh) often *= 0.99;
    TypeParam wavering;
    wavering.set_history({.queries = often});
    wavering.build(scene.boxes());
    int changes = 0;
    for (int frame = 1; frame < 64; ++frame) {
        const BroadPhaseKind before = wavering.kind();
        changes += update(wavering, frame % 2 == 0 ? often * 0.8 : often * 1.2) != before ? 1 : 0;
    }
    EXPECT_EQ(changes, 0);
}

constexpr std::array all_kinds{BroadPhaseKind::brute_force,     BroadPhaseKind::grid, BroadPhaseKind::layered_grid,
                               BroadPhaseKind::sweep_and_prune, BroadPhaseKind::bvh,  BroadPhaseKind::bsp};

/// Pairs between two structures of any kinds and sizes, with empty boxes and unbounded ones.
TYPED_TEST(Choices, AnyTwoKindsFindTheirPairs) {
    constexpr int D = dimension_of<TypeParam>;
    oracle::Random random(7);
    const auto many = make_scene<D>(Scene::holes_and_endless, 400, random);
    const auto few = make_scene<D>(Scene::holes_and_endless, 30, random);
    BruteForce<D> oracle, few_oracle;
    oracle.build(many);
    few_oracle.build(few);
    std::vector<detail::ItemPair> expected, found;
    oracle.each_overlapping_pair(few_oracle, [&](std::uint32_t i, std::uint32_t j) { expected.emplace_back(i, j); });
    EXPECT_GT(expected.size(), 100u);
    for (const BroadPhaseKind kind : all_kinds)
        for (const BroadPhaseKind other : all_kinds) {
            SCOPED_TRACE(testing::Message() << static_cast<int>(kind) << " and " << static_cast<int>(other));
            TypeParam phase(kind), few_phase(other);
            phase.build(many);
            few_phase.build(few);
            EXPECT_EQ(phase.kind(), kind);
            found.clear();
            phase.each_overlapping_pair(few_phase, [&](std::uint32_t i, std::uint32_t j) { found.emplace_back(i, j); });
            std::sort(found.begin(), found.end());
            EXPECT_EQ(found, expected);
            found.clear();
            few_phase.each_overlapping_pair(phase, [&](std::uint32_t j, std::uint32_t i) { found.emplace_back(i, j); });
            std::sort(found.begin(), found.end());
            EXPECT_EQ(found, expected);
            int visited_count = 0;
            phase.each_overlapping_pair(few_phase, [&](std::uint32_t, std::uint32_t) { return ++visited_count < 5; });
            EXPECT_EQ(visited_count, 5);
        }
}

/// A kind that the user fixed stays, with any boxes and any number of queries.
TYPED_TEST(Choices, StayWhereTheyAreForced) {
    constexpr int D = dimension_of<TypeParam>;
    scenes::MovingBoxes<D> scene(300, 3);
    for (const BroadPhaseKind kind : all_kinds) {
        TypeParam phase(kind);
        phase.build(scene.boxes());
        phase.set_history({.queries = 1});
        for (int frame = 0; frame < 70; ++frame) {
            scene.step();
            phase.update(scene.boxes());
            EXPECT_EQ(phase.kind(), kind);
        }
    }
}

}  // namespace
}  // namespace abut::test
