// Sweeps of a box through every broad phase visit each box that it touches once, and none beyond the reach.

#include "scenes.hpp"
#include "structures.hpp"
#include <abut/broad_phase/reach.hpp>

#include <algorithm>

namespace abut::test {
namespace {

template <class T>
class Sweep : public EachBroadPhase<T> {};
TYPED_TEST_SUITE(Sweep, AllBroadPhases);

/// A random moving box through the boxes: at rest, along an axis or diagonal; sometimes of size 0, or with a motion
/// longer than the scene.
template <int D>
MovingBox<D> some_way(oracle::Random& random, const DVec<D>& low, const DVec<D>& extent) {
    MovingBox<D> result;
    result.center = low + (DVec<D>(0.5) + 0.5 * random.in_cube<D>()) * extent;
    for (int i = 0; i < D; ++i) result.half[i] = random.chance(0.3) ? 0 : 0.02 * random.unit() * extent[0];
    result.direction = random.in_cube<D>() * extent;
    if (random.chance(0.3)) result.direction[static_cast<int>(random.below(D))] = 0;
    if (random.chance(0.05)) result.direction = DVec<D>(0.0);
    result.length = random.chance(0.1) ? 1e6 : random.uniform(0, 1);
    if (random.chance(0.05)) result.length = std::numeric_limits<double>::infinity();
    return result;
}

/// The bounded boxes of a scene.
template <int D>
Aabb<D> finite_bounds(const std::vector<Aabb<D>>& boxes) {
    Aabb<D> result = Aabb<D>::empty();
    for (const Aabb<D>& box : boxes) {
        bool finite = true;
        for (int i = 0; i < D; ++i) finite = finite && std::isfinite(box.min[i]) && std::isfinite(box.max[i]);
        if (finite && box.min[0] <= box.max[0]) result = merged(result, box);
    }
    return result;
}

template <int D>
void comes_to_all_that_it_touches(const AnyBroadPhase<D>& empty) {
    oracle::Random random(21);
    int touching = 0, missed = 0;
    for (int round = 0; round < 64; ++round) {
        SCOPED_TRACE("round " + std::to_string(round));
        const Scene scene = all_scenes[static_cast<std::size_t>(round) % all_scenes.size()];
        const auto boxes = make_scene<D>(scene, 200, random);
        AnyBroadPhase<D> phase = empty;
        phase.build(boxes);
        const Aabb<D> bounds = finite_bounds(boxes);
        const DVec<D> low(bounds.min), extent = DVec<D>(bounds.max) - low;
        for (int i = 0; i < 20; ++i) {
            const MovingBox<D> moving = some_way<D>(random, low, extent);
            const detail::RayReach<D> reach = detail::RayReach<D>::of_box(moving);
            std::vector<int> visited_count(boxes.size());
            phase.sweep(moving, [&](std::uint32_t item) { ++visited_count[item]; });
            for (std::size_t k = 0; k < boxes.size(); ++k) {
                double enters = 0;
                const bool touched = boxes[k].min[0] <= boxes[k].max[0] && reach.measure(boxes[k], enters);
                ASSERT_EQ(visited_count[k], touched ? 1 : 0) << k;
                ++(touched ? touching : missed);
            }
        }
    }
    EXPECT_GT(touching, 1000);
    EXPECT_GT(missed, 1000);
}
TYPED_TEST(Sweep, ComesToAllThatItTouches) {
    comes_to_all_that_it_touches(this->empty);
}

template <int D>
void stops_where_the_reach_ends(const AnyBroadPhase<D>& empty, bool in_order) {
    oracle::Random random(22);
    std::size_t visited = 0, touched = 0;
    for (int round = 0; round < 40; ++round) {
        SCOPED_TRACE("round " + std::to_string(round));
        const auto boxes = make_scene<D>(round % 2 == 0 ? Scene::uniform : Scene::mixed_sizes, 400, random);
        AnyBroadPhase<D> phase = empty;
        phase.build(boxes);
        const Aabb<D> bounds = finite_bounds(boxes);
        const DVec<D> low(bounds.min), extent = DVec<D>(bounds.max) - low;
        MovingBox<D> moving = some_way<D>(random, low, extent);
        moving.length = 1;
        const detail::RayReach<D> reach = detail::RayReach<D>::of_box(moving);
        std::vector<float> entries;
        for (const Aabb<D>& box : boxes) {
            double enters = 0;
            if (reach.measure(box, enters)) entries.push_back(static_cast<float>(enters));
        }
        std::sort(entries.begin(), entries.end());
        touched += entries.size();
        // A visitor that returns each entry finds the first item.
        float first = std::numeric_limits<float>::infinity();
        phase.sweep(moving, [&](std::uint32_t item) -> float {
            double enters = 0;
            EXPECT_TRUE(reach.measure(boxes[item], enters));
            ++visited;
            return first = std::min(first, static_cast<float>(enters));
        });
        ASSERT_EQ(first, entries.empty() ? std::numeric_limits<float>::infinity() : entries.front());
        int visited_count = 0;
        phase.sweep(moving, [&](std::uint32_t) { return ++visited_count < 1; });
        ASSERT_EQ(visited_count, entries.empty() ? 0 : 1);
    }
    EXPECT_GT(touched, 200u);
    if (in_order) {
        EXPECT_LT(visited, touched) << "a search beyond the first item found";
    }
}
TYPED_TEST(Sweep, StopsWhereTheReachEnds) {
    constexpr int D = dimension_of<TypeParam>;
    constexpr bool in_order =
        !std::is_same_v<TypeParam, BruteForce<D>> && !std::is_same_v<TypeParam, ChosenBroadPhase<D>>;
    stops_where_the_reach_ends(this->empty, in_order);
}

template <int D>
void of_nothing_finds_nothing(const AnyBroadPhase<D>& empty) {
    AnyBroadPhase<D> phase = empty;
    const MovingBox<D> along{DVec<D>(0.0), DVec<D>(1.0), DVec<D>(1.0), 10};
    phase.sweep(along, [](std::uint32_t) { FAIL(); });
    phase.build(std::vector<Aabb<D>>{{Vec<D>(-1), Vec<D>(1)}, Aabb<D>::empty()});
    int visited_count = 0;
    phase.sweep(along, [&](std::uint32_t item) { visited_count += item == 0 ? 1 : 100; });
    EXPECT_EQ(visited_count, 1);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (MovingBox<D> bad : {MovingBox<D>{DVec<D>(nan), DVec<D>(1.0), DVec<D>(1.0), 1},
                             MovingBox<D>{DVec<D>(0.0), DVec<D>(1.0), DVec<D>(nan), 1},
                             MovingBox<D>{DVec<D>(0.0), DVec<D>(1.0), DVec<D>(1.0), nan},
                             MovingBox<D>{DVec<D>(0.0), DVec<D>(1.0), DVec<D>(1.0), -1}})
        phase.sweep(bad, [](std::uint32_t) { FAIL(); });
}
TYPED_TEST(Sweep, OfNothingFindsNothing) {
    of_nothing_finds_nothing(this->empty);
}

}  // namespace
}  // namespace abut::test
