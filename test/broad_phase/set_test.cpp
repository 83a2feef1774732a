// Single boxes changed in a broad phase: it answers as one built of the same boxes, and nothing is allocated.

#include "../oracle/random.hpp"
#include "allocations.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/chosen_broad_phase.hpp>
#include <abut/broad_phase/grid.hpp>

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

template <int D>
Aabb<D> any_box(oracle::Random& random, double extent) {
    if (random.chance(0.05)) return Aabb<D>::empty();
    const Vec<D> corner = to_float(random.in_cube<D>() * extent);
    Aabb<D> result{corner, corner + Vec<D>(random.uniform_float(0, random.chance(0.02) ? 10.0f : 1.0f))};
    if (random.chance(0.02)) result.max[0] = std::numeric_limits<float>::infinity();
    return result;
}

template <int D>
class Pair {
public:
    using Items = std::vector<std::uint32_t>;

    template <class Phase>
    static Items overlapping(const Phase& phase, const Aabb<D>& box) {
        Items result;
        phase.each_overlapping(box, [&](std::uint32_t i) { result.push_back(i); });
        std::sort(result.begin(), result.end());
        return result;
    }
    template <class Phase>
    static std::vector<ItemPair> pairs(const Phase& phase) {
        std::vector<ItemPair> result;
        phase.sorted_pairs(result);
        return result;
    }
};

template <class Phase, int D>
void expect_as_built(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    oracle::Random random(seed);
    std::vector<Aabb<D>> boxes;
    Phase phase;
    phase.build(boxes);
    std::size_t found = 0, refused = 0;
    for (int round = 0; round < 400; ++round) {
        for (std::uint32_t i = random.below(4); i > 0; --i) {
            phase.insert(Aabb<D>::empty());
            boxes.push_back(Aabb<D>::empty());
        }
        for (std::size_t changes = random.below(20); changes > 0 && !boxes.empty(); --changes) {
            const std::uint32_t i = random.below(static_cast<std::uint32_t>(boxes.size()));
            const bool near = random.chance(0.6) && boxes[i].min[0] <= boxes[i].max[0];
            boxes[i] = near ? grown(boxes[i], 0.1f) : any_box<D>(random, round % 100 < 50 ? 10 : 100);
            const std::size_t before = allocations();
            const bool set = phase.set(i, boxes[i]);
            if (!set) phase.update(boxes);
            EXPECT_EQ(allocations(), before) << boxes.size();
            refused += set ? 0 : 1;
        }
        if (random.chance(0.05)) phase.update(boxes);
        BruteForce<D> built;
        built.build(boxes);
        const Aabb<D> box = grown(any_box<D>(random, 10), 1);
        const auto expected = Pair<D>::overlapping(built, box);
        ASSERT_EQ(Pair<D>::overlapping(phase, box), expected);
        found += expected.size();
        if (round % 20 == 0) {
            ASSERT_EQ(Pair<D>::pairs(phase), Pair<D>::pairs(built));
        }
    }
    EXPECT_GT(found, 100u);
    EXPECT_LT(refused, 100u);
}

TEST(Set, AnswersAsBuilt) {
    expect_as_built<BruteForce<2>, 2>(1);
    expect_as_built<BruteForce<3>, 3>(2);
    expect_as_built<Grid<2>, 2>(3);
    expect_as_built<Grid<3>, 3>(4);
    expect_as_built<Bvh<2>, 2>(5);
    expect_as_built<Bvh<3>, 3>(6);
}

/// All boxes move one by one, several times: the capacity always suffices.
template <class Phase, int D>
void expect_room_for_all(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    oracle::Random random(seed);
    std::vector<Aabb<D>> boxes(2000);
    for (Aabb<D>& box : boxes) box = any_box<D>(random, 50);
    Phase phase;
    phase.build(boxes);
    std::size_t refused = 0;
    const std::size_t before = allocations();
    for (int lap = 0; lap < 5; ++lap)
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            boxes[i] = any_box<D>(random, 50);
            if (phase.set(i, boxes[i])) continue;
            ++refused;
            phase.update(boxes);
        }
    EXPECT_EQ(allocations(), before);
    EXPECT_LT(refused, 200u) << "of 10000";
    BruteForce<D> built;
    built.build(boxes);
    EXPECT_EQ(Pair<D>::pairs(phase), Pair<D>::pairs(built));
}

TEST(Set, FindsRoomForAll) {
    expect_room_for_all<Grid<2>, 2>(11);
    expect_room_for_all<Grid<3>, 3>(12);
    expect_room_for_all<Bvh<2>, 2>(13);
    expect_room_for_all<Bvh<3>, 3>(14);
}

}  // namespace
}  // namespace abut::test
