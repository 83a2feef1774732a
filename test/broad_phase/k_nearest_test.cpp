// The k nearest by every broad phase, against all boxes sorted.

#include "allocations.hpp"
#include "scenes.hpp"
#include "structures.hpp"
#include <abut/broad_phase/k_nearest.hpp>

#include <algorithm>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

template <int D>
std::vector<NearItem> by_sorting(const std::vector<Aabb<D>>& boxes, const Vec<D>& point, std::size_t k) {
    std::vector<NearItem> result;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const Aabb<D>& box = boxes[i];
        double squared = 0;
        bool empty = false;
        for (int axis = 0; axis < D; ++axis) {
            const double gap = std::max({static_cast<double>(box.min[axis]) - static_cast<double>(point[axis]),
                                         static_cast<double>(point[axis]) - static_cast<double>(box.max[axis]), 0.0});
            squared += gap * gap;
            empty = empty || box.min[axis] > box.max[axis];
        }
        if (!empty) result.push_back({static_cast<float>(std::sqrt(squared)), i});
    }
    std::sort(result.begin(), result.end());
    result.resize(std::min(k, result.size()));
    return result;
}

template <class T>
class KNearest : public EachBroadPhase<T> {};
TYPED_TEST_SUITE(KNearest, AllBroadPhases);

template <int D>
void like_sorting_all(const AnyBroadPhase<D>& empty) {
    for (const Scene scene : all_scenes)
        for (const std::uint32_t count : {0u, 1u, 10u, 400u}) {
            oracle::Random random(14);
            const auto boxes = make_scene<D>(scene, count, random);
            AnyBroadPhase<D> phase = empty;
            phase.build(boxes);
            std::vector<NearItem> found{{1, 1}};
            for (const std::size_t k : {0u, 1u, 2u, 7u, 100u, 1000u})
                for (int repeat = 0; repeat < 4; ++repeat) {
                    Vec<D> point(random.in_cube<D>() * 15.0);
                    if (repeat == 0) point = Vec<D>(glm::vec<D, int>(point));  // equally far from many
                    k_nearest(phase, boxes, point, k, found);
                    EXPECT_EQ(found, by_sorting<D>(boxes, point, k))
                        << "scene " << static_cast<int>(scene) << " of " << count << ", k " << k << ", seed 14";
                }
        }
}
TYPED_TEST(KNearest, LikeSortingAll) {
    like_sorting_all(this->empty);
}

template <int D>
void of_equally_far_the_lower_indices(const AnyBroadPhase<D>& empty) {
    std::vector<Aabb<D>> boxes(30, {Vec<D>(0.1f), Vec<D>(1)});
    boxes[17] = {Vec<D>(-1), Vec<D>(1)};
    boxes[4] = Aabb<D>::empty();
    AnyBroadPhase<D> phase = empty;
    phase.build(boxes);
    std::vector<NearItem> found;
    k_nearest(phase, boxes, Vec<D>(-0.3f), 5, found);
    ASSERT_EQ(found.size(), 5u);
    EXPECT_EQ(found[0], (NearItem{0, 17}));
    for (std::uint32_t k = 1; k < 5; ++k) EXPECT_EQ(found[k].item, k - 1);
    // The distances are so small that hardly any float lies between them.
    // The items of lower index are on the side that a sweep reaches later.
    boxes.assign(30, {Vec<D>(1e-45f), Vec<D>(1)});
    for (std::size_t i = 15; i < 30; ++i) boxes[i] = {Vec<D>(-1), Vec<D>(-1e-45f)};
    phase.build(boxes);
    k_nearest(phase, boxes, Vec<D>(0), 3, found);
    ASSERT_EQ(found.size(), 3u);
    for (std::uint32_t k = 0; k < 3; ++k) EXPECT_EQ(found[k].item, k);
}
TYPED_TEST(KNearest, OfEquallyFarTheLowerIndices) {
    of_equally_far_the_lower_indices(this->empty);
}

template <int D>
void allocates_nothing_where_there_is_room_for_k(const AnyBroadPhase<D>& empty) {
    oracle::Random random(15);
    const auto boxes = make_scene<D>(Scene::uniform, 300, random);
    AnyBroadPhase<D> phase = empty;
    phase.build(boxes);
    std::vector<NearItem> found;
    found.reserve(20);
    const std::size_t before = allocations();
    k_nearest(phase, boxes, Vec<D>(1), 20, found);
    EXPECT_EQ(allocations(), before);
    EXPECT_EQ(found.size(), 20u);
}
TYPED_TEST(KNearest, AllocatesNothingWhereThereIsRoomForK) {
    allocates_nothing_where_there_is_room_for_k(this->empty);
}

}  // namespace
}  // namespace abut::test
