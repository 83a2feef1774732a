// Sweep and prune: many columns, new plans, and sorted orders that remain or are sorted anew.

#include "../../scenes/moving_boxes.hpp"
#include "dimensions.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/sweep_and_prune.hpp>

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using Pairs = std::vector<ItemPair>;

template <int D>
Pairs pairs_of(const SweepAndPrune<D>& phase) {
    Pairs result;
    phase.sorted_pairs(result);
    return result;
}

template <int D>
Pairs every_pair(std::span<const Aabb<D>> boxes) {
    BruteForce<D> oracle;
    oracle.build(boxes);
    Pairs result;
    oracle.sorted_pairs(result);
    return result;
}

/// The pairs or items that are reported twice, or not at all.
template <int D>
void expect_right(const SweepAndPrune<D>& phase, std::span<const Aabb<D>> boxes, oracle::Random& random) {
    const Pairs expected = every_pair(boxes);
    EXPECT_TRUE(pairs_of(phase) == expected) << pairs_of(phase).size() << " pairs, not " << expected.size();
    BruteForce<D> oracle;
    oracle.build(boxes);
    std::size_t found = 0;
    for (int repeat = 0; repeat < 20; ++repeat) {
        const Aabb<D>& near = boxes[random.below(static_cast<std::uint32_t>(boxes.size()))];
        const Aabb<D> query = grown(near, random.uniform_float(0, 10));
        const auto items = [&](const auto& of) {
            std::array<std::vector<std::uint32_t>, 3> result;
            of.each_overlapping(query, [&](std::uint32_t i) { result[0].push_back(i); });
            of.raycast(Ray<D>::between(query.min, query.max), [&](std::uint32_t i) { result[1].push_back(i); });
            of.closest(
                query.max, [&](std::uint32_t i) { result[2].push_back(i); }, 3);
            for (auto& list : result) std::sort(list.begin(), list.end());
            return result;
        };
        EXPECT_EQ(items(phase), items(oracle));
        found += items(oracle)[0].size();
    }
    EXPECT_GT(found, 20u);
}

template <class T>
class SweepAndPruneIn : public testing::Test {};
TYPED_TEST_SUITE(SweepAndPruneIn, Both);

TYPED_TEST(SweepAndPruneIn, ManyColumnsWhileAllMove) {
    constexpr int D = TypeParam::value;
    oracle::Random random(3);
    scenes::MovingBoxes<D> scene(12000, 3);
    SweepAndPrune<D> phase;
    phase.build(scene.boxes());
    EXPECT_GE(phase.plan().columns(), 8u);
    for (int frame = 0; frame < 3; ++frame) {
        expect_right<D>(phase, scene.boxes(), random);
        scene.step();
        phase.update(scene.boxes());
    }
}

TYPED_TEST(SweepAndPruneIn, GiantsAndEndlessBoxesInManyColumns) {
    constexpr int D = TypeParam::value;
    for (const std::uint32_t giants : {3u, 300u}) {
        SCOPED_TRACE(testing::Message() << giants << " giants, seed 8");
        oracle::Random random(8);
        const scenes::MovingBoxes<D> scene(8000, 8);
        std::vector<Aabb<D>> boxes(scene.boxes().begin(), scene.boxes().end());
        SweepAndPrune<D> grows_later;
        grows_later.build(boxes);
        for (std::uint32_t i = 0; i < giants; ++i) {
            Aabb<D>& box = boxes[random.below(8000)];
            box = random.chance(0.2) ? endless_box<D>(random) : grown(box, random.uniform_float(0, scene.side()));
        }
        grows_later.update(boxes);
        expect_right<D>(grows_later, boxes, random);
        SweepAndPrune<D> phase;
        phase.build(boxes);
        expect_right<D>(phase, boxes, random);
    }
}

TYPED_TEST(SweepAndPruneIn, SortsAlongTheAxisThatPartsTheBoxes) {
    constexpr int D = TypeParam::value;
    for (int longest = 0; longest < D; ++longest) {
        oracle::Random random(static_cast<std::uint64_t>(longest) + 1);
        std::vector<Aabb<D>> boxes;
        for (int i = 0; i < 500; ++i) {
            DVec<D> place = random.in_cube<D>() * 5.0;
            place[longest] *= 100;
            boxes.push_back(box_at<D>(place, DVec<D>(0.5)));
        }
        SweepAndPrune<D> phase;
        phase.build(boxes);
        EXPECT_EQ(phase.plan().axis, longest);
        // A reversal of the order would compare every item with every other.
        for (Aabb<D>& box : boxes) box = detail::turned<D>(box, 1);
        phase.update(boxes);
        EXPECT_EQ(phase.plan().axis, (longest + D - 1) % D);
        expect_right<D>(phase, boxes, random);
    }
}

TYPED_TEST(SweepAndPruneIn, HasOneOrderWhereverItComesFrom) {
    constexpr int D = TypeParam::value;
    oracle::Random random(6);
    // With integer coordinates, some boxes begin at the same place. They are far apart on axis 0, because columns have
    // their own order.
    std::vector<Aabb<D>> boxes;
    for (int i = 0; i < 300; ++i) {
        Vec<D> corner(glm::vec<D, int>(random.in_cube<D>() * 3.0));
        corner[0] = static_cast<float>(random.below(200));
        boxes.push_back({corner, corner + Vec<D>(1)});
    }
    SweepAndPrune<D> updated;
    updated.build(boxes);
    for (const int moved : {1, 20, 100, 300}) {
        for (int i = 0; i < moved; ++i) {
            Aabb<D>& box = boxes[random.below(300)];
            const float step = random.chance(0.5) ? 1 : -1;
            box.min[0] += step;
            box.max[0] += step;
        }
        updated.update(boxes);
        SweepAndPrune<D> fresh;
        fresh.build(boxes);
        Pairs order, fresh_order;
        updated.each_pair([&](std::uint32_t i, std::uint32_t j) { order.emplace_back(i, j); });
        fresh.each_pair([&](std::uint32_t i, std::uint32_t j) { fresh_order.emplace_back(i, j); });
        ASSERT_EQ(updated.plan().axis, 0);
        ASSERT_EQ(updated.plan().columns(), 1u);
        EXPECT_EQ(order, fresh_order) << moved;
        EXPECT_GT(order.size(), 100u);
    }
}

TEST(SweepAndPrune, ZeroesOfEitherSignAreOnePlace) {
    std::vector<Aabb2> boxes;
    for (int i = 0; i < 40; ++i) {
        const float zero = i % 2 == 0 ? 0.0f : -0.0f;
        boxes.push_back({{zero, zero}, {i % 3 == 0 ? -zero : 1.0f, zero}});
    }
    SweepAndPrune<2> phase;
    phase.build(boxes);
    EXPECT_EQ(pairs_of(phase).size(), 40u * 39 / 2);
}

TEST(SweepAndPrune, VisitsTheNearestFirst) {
    scenes::MovingBoxes<3> scene(20000, 5);
    SweepAndPrune<3> phase;
    phase.build(scene.boxes());
    oracle::Random random(5);
    std::size_t visits = 0;
    for (int repeat = 0; repeat < 200; ++repeat) {
        const Vec3 point(random.in_cube<3>() * static_cast<double>(scene.side()));
        phase.closest(point, [&](std::uint32_t i) {
            ++visits;
            const Vec3 gap = max(max(scene.boxes()[i].min - point, point - scene.boxes()[i].max), Vec3(0));
            return static_cast<float>(length(DVec<3>(gap)));
        });
        const Ray3 ray{point, Vec3(random.direction<3>())};
        phase.raycast(ray, [&](std::uint32_t i) {
            ++visits;
            double enters = 0;
            RayReach<3>(ray).measure(scene.boxes()[i], enters);
            return static_cast<float>(enters);
        });
    }
    EXPECT_LT(visits, 200u * 20) << "of 20,000 boxes each time";
}

TEST(SweepAndPrune, KeepsToItsMemory) {
    // The documented bounds of copies and columns hold for all boxes.
    for (const double edge : {0.01, 1.0, 30.0}) {
        oracle::Random random(2);
        std::vector<Aabb3> boxes;
        for (int i = 0; i < 5000; ++i) boxes.push_back(box_at<3>(random.in_cube<3>() * 50.0, DVec<3>(edge)));
        SweepAndPrune<3> phase;
        phase.build(boxes);
        EXPECT_LE(phase.plan().columns(), 5000u / 16 + 1);
        EXPECT_EQ(pairs_of(phase).size(), every_pair<3>(boxes).size());
    }
}

}  // namespace
}  // namespace abut::test
