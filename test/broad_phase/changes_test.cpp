// Items that come and go one by one, in all broad phases that can do so.

#include "../../scenes/moving_boxes.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/grid.hpp>

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class T>
class Changes : public testing::Test {};
using Changing = testing::Types<BruteForce<2>, BruteForce<3>, Grid<2>, Grid<3>, Bvh<2>, Bvh<3>>;
TYPED_TEST_SUITE(Changes, Changing);

template <class Phase, class Box>
std::vector<std::uint32_t> overlapping(const Phase& phase, const Box& box) {
    std::vector<std::uint32_t> result;
    phase.each_overlapping(box, [&](std::uint32_t i) { result.push_back(i); });
    std::sort(result.begin(), result.end());
    return result;
}

template <class Phase, int D>
std::vector<std::uint32_t> near(const Phase& phase, const Vec<D>& point, float reach) {
    std::vector<std::uint32_t> result;
    phase.closest(
        point, [&](std::uint32_t i) { result.push_back(i); }, reach);
    std::sort(result.begin(), result.end());
    return result;
}

template <class Phase, int D>
std::vector<std::uint32_t> along(const Phase& phase, const Ray<D>& ray) {
    std::vector<std::uint32_t> result;
    phase.raycast(ray, [&](std::uint32_t i) { result.push_back(i); });
    std::sort(result.begin(), result.end());
    return result;
}

template <class Phase, int D = dimension_of<Phase>>
void expect_same(const Phase& phase, const std::vector<Aabb<D>>& boxes, oracle::Random& random) {
    BruteForce<D> oracle;
    oracle.build(boxes);
    ASSERT_EQ(phase.size(), boxes.size());
    EXPECT_EQ(phase.bounds(), oracle.bounds());
    std::vector<detail::ItemPair> pairs, expected;
    phase.sorted_pairs(pairs);
    oracle.sorted_pairs(expected);
    ASSERT_EQ(pairs, expected);
    const Aabb<D> box = some_box<D>(random, 12, 4);
    EXPECT_EQ(overlapping(phase, box), overlapping(oracle, box));
    const Vec<D> point(random.in_cube<D>() * 15.0);
    const Ray<D> ray{point, Vec<D>(random.direction<D>()), 20};
    EXPECT_EQ((along<Phase, D>(phase, ray)), (along<BruteForce<D>, D>(oracle, ray)));
    EXPECT_EQ((near<Phase, D>(phase, point, 3)), (near<BruteForce<D>, D>(oracle, point, 3)));
}

TYPED_TEST(Changes, ItemsComeAndGoInAnyOrder) {
    constexpr int D = dimension_of<TypeParam>;
    for (std::uint64_t seed = 100; seed < 120; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const Scene scene = all_scenes[seed % all_scenes.size()];
        std::vector<Aabb<D>> boxes;
        if (random.chance(0.7)) boxes = make_scene<D>(scene, random.below(300), random);
        std::set<std::uint32_t> erased;
        TypeParam phase;
        phase.build(boxes);
        for (int step = 0; step < 60; ++step) {
            const double what = random.unit();
            const std::uint32_t count = random.below(random.chance(0.1) ? 200 : 12);
            if (what < 0.45) {
                for (const Aabb<D>& box : make_scene<D>(scene, count, random)) {
                    const std::uint32_t index = phase.insert(box);
                    const auto expected = erased.empty() ? boxes.size() : *erased.begin();
                    ASSERT_EQ(index, expected) << "the least that is free, or the next";
                    if (index == boxes.size()) boxes.emplace_back();
                    boxes[index] = box;
                    erased.erase(index);
                }
            } else if (what < 0.8 && !boxes.empty()) {
                for (std::uint32_t i = 0; i < count; ++i) {
                    const auto index = random.below(static_cast<std::uint32_t>(boxes.size()));
                    phase.erase(index);
                    boxes[index] = Aabb<D>::empty();
                    erased.insert(index);
                }
            } else {
                move_some(boxes, random);
                // An item that was erased may be in use again by an update.
                for (const std::uint32_t index : erased)
                    if (random.chance(0.9)) boxes[index] = Aabb<D>::empty();
                phase.update(boxes);
                for (auto i = erased.begin(); i != erased.end();) {
                    const Aabb<D>& box = boxes[*i];
                    i = box.min[0] <= box.max[0] ? erased.erase(i) : std::next(i);
                }
            }
            expect_same(phase, boxes, random);
            if (testing::Test::HasFailure()) return;
        }
    }
}

TYPED_TEST(Changes, AllMayGoAndComeBack) {
    constexpr int D = dimension_of<TypeParam>;
    oracle::Random random(5);
    std::vector<Aabb<D>> boxes = make_scene<D>(Scene::uniform, 400, random);
    TypeParam phase;
    for (int round = 0; round < 3; ++round) {
        for (const Aabb<D>& box : boxes) phase.insert(box);
        expect_same(phase, boxes, random);
        for (std::uint32_t i = 0; i < boxes.size(); ++i) phase.erase(i);
        EXPECT_EQ(phase.size(), boxes.size());
        EXPECT_EQ(phase.bounds(), Aabb<D>::empty());
        phase.erase(3);  // once more is nothing
    }
    phase.update(boxes);
    expect_same(phase, boxes, random);
}

TYPED_TEST(Changes, MayBeginWithNothing) {
    constexpr int D = dimension_of<TypeParam>;
    oracle::Random random(6);
    TypeParam phase;
    std::vector<Aabb<D>> boxes{Aabb<D>::empty()};
    EXPECT_EQ(phase.insert(boxes[0]), 0u) << "an empty box is an item";
    for (const Aabb<D>& box : make_scene<D>(Scene::touching_grid, 40, random)) {
        EXPECT_EQ(phase.insert(box), boxes.size());
        boxes.push_back(box);
        expect_same(phase, boxes, random);
    }
}

/// One after the other along the first axis: what comes last lies beyond all cells that were chosen before.
template <int D>
void add_one_by_one(bool sorted) {
    const scenes::MovingBoxes<D> scene(100000, 3);
    std::vector<Aabb<D>> boxes(scene.boxes().begin(), scene.boxes().end());
    if (sorted)
        std::sort(boxes.begin(), boxes.end(), [](const auto& a, const auto& b) {
            return std::tie(a.min.x, a.min.y, a.max.x, a.max.y) < std::tie(b.min.x, b.min.y, b.max.x, b.max.y);
        });
    Grid<D> grid, fresh;
    for (const Aabb<D>& box : boxes) grid.insert(box);
    fresh.build(boxes);
    EXPECT_LT(grid.pair_cost(), 1.6 * fresh.pair_cost()) << sorted;
    grid.update(boxes);
    std::vector<detail::ItemPair> pairs, expected;
    grid.sorted_pairs(pairs);
    fresh.sorted_pairs(expected);
    EXPECT_EQ(pairs, expected);
}
TEST(GridChanges, AddingOneByOneMakesNoBadGrid) {
    for (const bool sorted : {false, true}) {
        add_one_by_one<2>(sorted);
        add_one_by_one<3>(sorted);
    }
}

}  // namespace
}  // namespace abut::test
