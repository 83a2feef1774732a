// Counts allocations: none in queries, none in updates once warm.

#include "allocations.hpp"
#include "scenes.hpp"
#include "structures.hpp"

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

template <class T>
class Allocations : public EachBroadPhase<T> {};
TYPED_TEST_SUITE(Allocations, AllBroadPhases);

template <int D>
void none_once_warm(const AnyBroadPhase<D>& empty) {
    oracle::Random random(4);
    auto boxes = make_scene<D>(Scene::holes_and_endless, 300, random);
    AnyBroadPhase<D> phase = empty;
    const std::size_t before_build = allocations();
    phase.build(boxes);
    EXPECT_GT(allocations(), before_build) << "the counter counts";
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    pairs.reserve(boxes.size() * boxes.size());

    const std::size_t before = allocations();
    std::size_t found = 0;
    for (int frame = 0; frame < 50; ++frame) {
        move_some(boxes, random);
        phase.update(boxes);
        phase.sorted_pairs(pairs);
        phase.each_pair([&](std::uint32_t, std::uint32_t) { ++found; });
        phase.each_overlapping_pair(phase, [&](std::uint32_t, std::uint32_t) { ++found; });
        phase.each_overlapping(Aabb<D>{Vec<D>(0), Vec<D>(5)}, [&](std::uint32_t) { ++found; });
        phase.raycast(Ray<D>{Vec<D>(0), Vec<D>(axis<D>(0))}, [&](std::uint32_t) { ++found; });
        phase.closest(Vec<D>(3), [&](std::uint32_t) { ++found; });
    }
    phase.build(boxes);
    EXPECT_EQ(allocations(), before);
    EXPECT_GT(found, 1000u);
}
TYPED_TEST(Allocations, NoneOnceWarm) {
    none_once_warm(this->empty);
}

template <int D>
void none_where_a_new_tree_is_larger(const AnyBroadPhase<D>& empty) {
    oracle::Random random(5);
    auto boxes = make_scene<D>(Scene::coincident, 256, random);
    AnyBroadPhase<D> phase = empty;
    phase.build(boxes);
    const auto apart = make_scene<D>(Scene::growing_gaps, 256, random);
    const std::size_t before = allocations();
    phase.update(apart);
    EXPECT_EQ(allocations(), before);
    boxes.assign(256, Aabb<D>::empty());
    phase.build(boxes);
    phase.update(apart);
    EXPECT_EQ(allocations(), before);
}
TYPED_TEST(Allocations, NoneWhereANewTreeIsLarger) {
    none_where_a_new_tree_is_larger(this->empty);
}

}  // namespace
}  // namespace abut::test
