// A tree that changes: items that come and go one by one, thousands of frames, and several threads.

#include "../../scenes/moving_boxes.hpp"
#include "executors.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bvh.hpp>

#include <algorithm>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class T>
class BvhChanges : public testing::Test {};
using Trees = testing::Types<Bvh<2>, Bvh<3>>;
TYPED_TEST_SUITE(BvhChanges, Trees);

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

template <int D>
void expect_same(const Bvh<D>& tree, const std::vector<Aabb<D>>& boxes, oracle::Random& random) {
    BruteForce<D> oracle;
    oracle.build(boxes);
    ASSERT_EQ(tree.size(), boxes.size());
    EXPECT_EQ(tree.bounds(), oracle.bounds());
    std::vector<ItemPair> pairs, expected;
    tree.sorted_pairs(pairs);
    oracle.sorted_pairs(expected);
    ASSERT_EQ(pairs, expected);
    const Aabb<D> box = some_box<D>(random, 12, 4);
    EXPECT_EQ(overlapping(tree, box), overlapping(oracle, box));
    const Vec<D> point(random.in_cube<D>() * 15.0);
    EXPECT_EQ((near<Bvh<D>, D>(tree, point, 3)), (near<BruteForce<D>, D>(oracle, point, 3)));
}

TYPED_TEST(BvhChanges, ItemsComeAndGoInAnyOrder) {
    constexpr int D = dimension_of<TypeParam>;
    for (std::uint64_t seed = 100; seed < 120; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const Scene scene = all_scenes[seed % all_scenes.size()];
        std::vector<Aabb<D>> boxes;
        if (random.chance(0.7)) boxes = make_scene<D>(scene, random.below(300), random);
        std::set<std::uint32_t> erased;
        TypeParam tree;
        tree.build(boxes);
        for (int step = 0; step < 60; ++step) {
            const double what = random.unit();
            const std::uint32_t count = random.below(random.chance(0.1) ? 200 : 12);
            if (what < 0.45) {
                for (const Aabb<D>& box : make_scene<D>(scene, count, random)) {
                    const std::uint32_t index = tree.insert(box);
                    const auto expected = erased.empty() ? boxes.size() : *erased.begin();
                    ASSERT_EQ(index, expected) << "the least that is free, or the next";
                    if (index == boxes.size()) boxes.emplace_back();
                    boxes[index] = box;
                    erased.erase(index);
                }
            } else if (what < 0.8 && !boxes.empty()) {
                for (std::uint32_t i = 0; i < count; ++i) {
                    const auto index = random.below(static_cast<std::uint32_t>(boxes.size()));
                    tree.erase(index);
                    boxes[index] = Aabb<D>::empty();
                    erased.insert(index);
                }
            } else {
                move_some(boxes, random);
                // An item that was erased may be in use again by an update.
                for (const std::uint32_t index : erased)
                    if (random.chance(0.9)) boxes[index] = Aabb<D>::empty();
                tree.update(boxes);
                for (auto i = erased.begin(); i != erased.end();) {
                    const Aabb<D>& box = boxes[*i];
                    i = box.min[0] <= box.max[0] ? erased.erase(i) : std::next(i);
                }
            }
            expect_same<D>(tree, boxes, random);
            if (testing::Test::HasFailure()) return;
        }
    }
}

TYPED_TEST(BvhChanges, AllMayGoAndComeBack) {
    constexpr int D = dimension_of<TypeParam>;
    oracle::Random random(5);
    std::vector<Aabb<D>> boxes = make_scene<D>(Scene::uniform, 400, random);
    TypeParam tree;
    for (int round = 0; round < 3; ++round) {
        for (const Aabb<D>& box : boxes) tree.insert(box);
        expect_same<D>(tree, boxes, random);
        for (std::uint32_t i = 0; i < boxes.size(); ++i) tree.erase(i);
        EXPECT_EQ(tree.size(), boxes.size());
        EXPECT_EQ(tree.bounds(), Aabb<D>::empty());
        tree.erase(3);  // once more is nothing
    }
    tree.update(boxes);
    expect_same<D>(tree, boxes, random);
}

TYPED_TEST(BvhChanges, AddingOneByOneMakesNoBadTree) {
    constexpr int D = dimension_of<TypeParam>;
    for (const bool sorted : {false, true}) {
        const scenes::MovingBoxes<D> scene(100000, 3);
        std::vector<Aabb<D>> boxes(scene.boxes().begin(), scene.boxes().end());
        if (sorted)
            std::sort(boxes.begin(), boxes.end(), [](const auto& a, const auto& b) {
                return std::tie(a.min.x, a.min.y, a.max.x, a.max.y) < std::tie(b.min.x, b.min.y, b.max.x, b.max.y);
            });
        TypeParam tree, fresh;
        for (const Aabb<D>& box : boxes) tree.insert(box);
        fresh.build(boxes);
        EXPECT_LT(tree.cost(), (sorted ? 2 : 1.6) * fresh.cost());
        tree.update(boxes);
        EXPECT_LT(tree.cost(), 1.1 * fresh.cost()) << "repaired";
        // And a few at a time, with updates between them.
        TypeParam grown;
        for (std::size_t i = 0; i < 20000; ++i) {
            grown.insert(boxes[i]);
            if (i % 500 == 499) grown.update(std::span(boxes).first(i + 1));
        }
        fresh.build(std::span(boxes).first(20000));
        EXPECT_LT(grown.cost(), 1.15 * fresh.cost());
    }
}

TYPED_TEST(BvhChanges, NeverDecays) {
    constexpr int D = dimension_of<TypeParam>;
    for (const bool crossing : {false, true}) {
        scenes::MovingBoxes<D> scene(2500, 4);
        std::vector<Aabb<D>> boxes(scene.boxes().begin(), scene.boxes().end());
        TypeParam tree, fresh;
        tree.build(boxes);
        double worst = 0, sum = 0;
        int compared = 0;
        for (int frame = 1; frame <= 10000; ++frame) {
            scene.step();
            std::copy(scene.boxes().begin(), scene.boxes().end(), boxes.begin());
            // Some cross the whole world in a hundred frames, each along its own axis, and begin anew.
            for (std::size_t i = 0; crossing && i < boxes.size(); i += 10) {
                const float way = scene.side() * 0.01f * static_cast<float>((frame + static_cast<int>(i)) % 100);
                const auto axis = static_cast<glm::length_t>(i / 10 % D);
                const float edge = boxes[i].max[axis] - boxes[i].min[axis];
                boxes[i].min[axis] = way;
                boxes[i].max[axis] = way + edge;
            }
            tree.update(boxes);
            if (frame % 97 != 0) continue;
            fresh.build(boxes);
            worst = std::max(worst, tree.cost() / fresh.cost());
            sum += tree.cost() / fresh.cost();
            ++compared;
        }
        EXPECT_LT(worst, 1.2) << crossing;
        EXPECT_LT(sum / compared, 1.1) << crossing;
    }
}

TYPED_TEST(BvhChanges, IsTheSameTreeWithSeveralThreads) {
    constexpr int D = dimension_of<TypeParam>;
    oracle::Random random(7);
    for (const Scene scene : {Scene::uniform, Scene::mixed_sizes, Scene::holes_and_endless}) {
        auto boxes = make_scene<D>(scene, 20000, random);
        TypeParam one, many[2];
        ThreadExecutor two(2), seven(7);
        one.build(boxes);
        many[0].build(boxes, &two);
        many[1].build(boxes, &seven);
        const auto order = [](const TypeParam& tree) {
            std::vector<std::uint32_t> result;
            constexpr float far = std::numeric_limits<float>::infinity();
            tree.each_overlapping({Vec<D>(-far), Vec<D>(far)}, [&](std::uint32_t i) { result.push_back(i); });
            return result;
        };
        for (int frame = 0; frame < 4; ++frame) {
            for (const TypeParam& tree : many) {
                EXPECT_EQ(order(tree), order(one));
                EXPECT_EQ(tree.cost(), one.cost());
            }
            move_some(boxes, random);
            one.update(boxes);
            many[0].update(boxes, &two);
            many[1].update(boxes, &seven);
        }
    }
}

}  // namespace
}  // namespace abut::test
