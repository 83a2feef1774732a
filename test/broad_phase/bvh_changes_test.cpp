// A tree that changes: items that come one by one, thousands of frames, and several threads.

#include "../../scenes/moving_boxes.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/bvh.hpp>
#include <abut/math/thread_pool.hpp>

#include <algorithm>
#include <tuple>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class T>
class BvhChanges : public testing::Test {};
using Trees = testing::Types<Bvh<2>, Bvh<3>>;
TYPED_TEST_SUITE(BvhChanges, Trees);

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
        // A few items are added at a time, with updates between them.
        TypeParam grown;
        for (std::size_t i = 0; i < 20000; ++i) {
            grown.insert(boxes[i]);
            if (i % 500 == 499) grown.update(std::span(boxes).first(i + 1));
        }
        fresh.build(std::span(boxes).first(20000));
        EXPECT_LT(grown.cost(), 1.15 * fresh.cost());
    }
}

// Regression: a tree without capacity for splits enlarged its leaves instead. After each of 10,000 items had been set
// to another place, its cost was 26 times (2D) and 45 times (3D) that of a new tree.
TYPED_TEST(BvhChanges, SettingItemsAnywhereMakesNoBadTree) {
    constexpr int D = dimension_of<TypeParam>;
    const std::size_t count = 5000;
    const scenes::MovingBoxes<D> scene(count, 5);
    std::vector<Aabb<D>> boxes(scene.boxes().begin(), scene.boxes().end());
    TypeParam tree, fresh;
    tree.build(boxes);
    for (std::uint64_t round = 0; round < 6; ++round) {
        const scenes::MovingBoxes<D> other(count, 6 + round);
        for (std::uint32_t i = 0; i < count; ++i) {
            boxes[i] = other.boxes()[i];
            ASSERT_TRUE(tree.set(i, boxes[i])) << "round " << round << ", item " << i;
        }
        fresh.build(boxes);
        EXPECT_LT(tree.cost(), 1.6 * fresh.cost()) << "round " << round;
        std::size_t found = 0, expected = 0;
        for (std::size_t i = 0; i < count; i += 50) {
            tree.each_overlapping(boxes[i], [&](std::uint32_t) { ++found; });
            for (const Aabb<D>& box : boxes) expected += overlaps(box, boxes[i]) ? 1u : 0u;
        }
        EXPECT_EQ(found, expected);
        EXPECT_GT(found, 2 * count / 50);
    }
    tree.update(boxes);
    EXPECT_LT(tree.cost(), 1.1 * fresh.cost()) << "repaired";
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
            // Some items cross the whole world in a hundred frames, each along its own axis, and then start again.
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
        ThreadPool two(2), seven(7);
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
