// Every broad phase against every pair: after a build, and after many updates.

#include "scenes.hpp"
#include "structures.hpp"
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/thread_pool.hpp>

#include <algorithm>
#include <memory>
#include <mutex>
#include <tuple>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
using Items = std::vector<std::uint32_t>;

/// Compares a broad phase with a test of every pair of its boxes.
template <int D>
struct Checks {
    using Phase = AnyBroadPhase<D>;
    static_assert(BroadPhase<Phase, D>);

    /// A broad phase of the same type.
    static Phase built(const Phase& like, const std::vector<Aabb<D>>& boxes) {
        Phase result = like;
        result.build(boxes);
        return result;
    }

    /// Compares all answers with those of testing every pair; returns the number of pairs.
    static std::size_t check(const Phase& phase, const std::vector<Aabb<D>>& boxes, oracle::Random& random) {
        BruteForce<D> oracle;
        oracle.build(boxes);
        const Pairs expected = check_pairs(phase, oracle);
        EXPECT_EQ(phase.size(), boxes.size());
        if (phase.bounds() != oracle.bounds()) ADD_FAILURE() << "bounds";
        check_boxes(phase, oracle);

        std::vector<Aabb<D>> others = boxes;
        others.resize(boxes.size() / 2);
        move_some(others, random);
        check_other(phase, oracle, others);
        for (int repeat = 0; repeat < 8; ++repeat) {
            const Aabb<D> box = random.chance(0.1) ? endless_box<D>(random) : some_box<D>(random, 12, 4);
            EXPECT_EQ(overlapping(phase, box), overlapping(oracle, box));
            check_ray(phase, oracle, boxes, some_ray(random));
            const Vec<D> point(random.in_cube<D>() * 15.0);
            check_closest(phase, oracle, boxes, point, random.uniform_float(0, 10));
        }
        return expected.size();
    }

    static Pairs check_pairs(const Phase& phase, const BruteForce<D>& oracle) {
        Pairs expected, sorted{{7, 7}}, visited;
        oracle.each_pair([&](std::uint32_t i, std::uint32_t j) { expected.emplace_back(i, j); });
        phase.sorted_pairs(sorted);
        EXPECT_EQ(sorted, expected);
        phase.each_pair([&](std::uint32_t i, std::uint32_t j) { visited.emplace_back(i, j); });
        std::sort(visited.begin(), visited.end());
        EXPECT_EQ(visited, expected);
        return expected;
    }

    static void check_boxes(const Phase& phase, const BruteForce<D>& oracle) {
        const auto boxes_of = [](const auto& structure) {
            std::vector<std::pair<std::uint32_t, Aabb<D>>> result;
            structure.each_box([&](std::uint32_t i, const Aabb<D>& box) { result.emplace_back(i, box); });
            std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
            return result;
        };
        EXPECT_EQ(boxes_of(phase), boxes_of(oracle));
    }

    static void check_other(const Phase& phase, const BruteForce<D>& oracle, const std::vector<Aabb<D>>& others) {
        BruteForce<D> other_oracle;
        other_oracle.build(others);
        Pairs expected, visited;
        oracle.each_overlapping_pair(other_oracle, [&](auto i, auto j) { expected.emplace_back(i, j); });
        built(phase, others).each_overlapping_pair(phase, [&](auto j, auto i) { visited.emplace_back(i, j); });
        std::sort(visited.begin(), visited.end());
        EXPECT_EQ(visited, expected);
    }

    template <class Structure>
    static Items overlapping(const Structure& phase, const Aabb<D>& box) {
        Items result;
        phase.each_overlapping(box, [&](std::uint32_t i) { result.push_back(i); });
        std::sort(result.begin(), result.end());
        return result;
    }

    static Ray<D> some_ray(oracle::Random& random) {
        Ray<D> ray{Vec<D>(random.in_cube<D>() * 12.0), Vec<D>(random.direction<D>())};
        if (random.chance(0.3))
            ray.direction = Vec<D>(axis<D>(static_cast<int>(random.below(D)), random.chance(0.5) ? 1 : -1));
        if (random.chance(0.3)) ray.origin = Vec<D>(glm::vec<D, int>(ray.origin));
        if (random.chance(0.5)) ray.length = random.chance(0.1) ? 0 : random.uniform_float(0, 20);
        return ray;
    }

    template <class Structure>
    static Items along(const Structure& phase, const Ray<D>& ray) {
        Items result;
        phase.raycast(ray, [&](std::uint32_t i) { result.push_back(i); });
        std::sort(result.begin(), result.end());
        return result;
    }

    static void check_ray(const Phase& phase, const BruteForce<D>& oracle, const std::vector<Aabb<D>>& boxes,
                          const Ray<D>& ray) {
        const Items expected = along(oracle, ray);
        EXPECT_EQ(along(phase, ray), expected);
        // The reach shrinks to each item's own hit.
        const auto first = [&](const auto& shape) {
            std::pair<float, std::uint32_t> best{std::numeric_limits<float>::infinity(), 0};
            shape.raycast(ray, [&](std::uint32_t i) {
                best = std::min(best, {made_up_distance(boxes[i], ray, i), i});
                return best.first;
            });
            return best;
        };
        EXPECT_EQ(first(phase), first(oracle));
    }

    /// The reach is not below the ray's entry into the item's box.
    static float made_up_distance(const Aabb<D>& box, const Ray<D>& ray, std::uint32_t item) {
        double enters = 0;
        EXPECT_TRUE(RayReach<D>(ray).measure(box, enters));
        return static_cast<float>(enters) + static_cast<float>((item * 7) % 3);
    }

    static void check_closest(const Phase& phase, const BruteForce<D>& oracle, const std::vector<Aabb<D>>& boxes,
                              const Vec<D>& point, float reach) {
        const auto near = [&](const auto& shape) {
            Items result;
            shape.closest(
                point, [&](std::uint32_t i) { result.push_back(i); }, reach);
            std::sort(result.begin(), result.end());
            return result;
        };
        EXPECT_EQ(near(phase), near(oracle));
        const auto nearest = [&](const auto& shape) {
            std::pair<float, std::uint32_t> best{std::numeric_limits<float>::infinity(), 0};
            shape.closest(point, [&](std::uint32_t i) {
                best = std::min(best, {distance(boxes[i], point), i});
                return best.first;
            });
            return best;
        };
        EXPECT_EQ(nearest(phase), nearest(oracle));
    }

    static float distance(const Aabb<D>& box, const Vec<D>& point) {
        DVec<D> gap;
        for (int i = 0; i < D; ++i) gap[i] = std::max({box.min[i] - point[i], point[i] - box.max[i], 0.0f});
        return static_cast<float>(length(gap));
    }
};

template <class T>
class BroadPhases : public EachBroadPhase<T> {};
TYPED_TEST_SUITE(BroadPhases, AllBroadPhases);

template <int D>
void agree_after_a_build(const AnyBroadPhase<D>& empty) {
    for (const Scene scene : all_scenes)
        for (const std::uint32_t count : {0u, 1u, 2u, 3u, 4u, 5u, 9u, 33u, 200u, 500u})
            for (std::uint64_t seed = 0; seed < 2; ++seed) {
                SCOPED_TRACE(testing::Message()
                             << "scene " << static_cast<int>(scene) << " of " << count << " seed " << seed);
                oracle::Random random(seed);
                const auto boxes = make_scene<D>(scene, count, random);
                const std::size_t pairs = Checks<D>::check(Checks<D>::built(empty, boxes), boxes, random);
                if (count == 500) {
                    EXPECT_GT(pairs, count / 4) << "too few to prove anything";
                }
            }
}
TYPED_TEST(BroadPhases, AgreeAfterABuild) {
    agree_after_a_build(this->empty);
}

template <int D>
void agree_after_every_update(const AnyBroadPhase<D>& empty) {
    for (const Scene scene : all_scenes) {
        oracle::Random random(11);
        auto boxes = make_scene<D>(scene, 150, random);
        auto phase = Checks<D>::built(empty, boxes);
        for (int frame = 0; frame < 40; ++frame) {
            SCOPED_TRACE(testing::Message() << "scene " << static_cast<int>(scene) << " seed 11 frame " << frame);
            move_some(boxes, random);
            phase.update(boxes);
            Checks<D>::check(phase, boxes, random);
            if (testing::Test::HasFailure()) return;
        }
    }
}
TYPED_TEST(BroadPhases, AgreeAfterEveryUpdate) {
    agree_after_every_update(this->empty);
}

template <int D>
void build_again_forgets_the_old_boxes(const AnyBroadPhase<D>& empty) {
    oracle::Random random(5);
    auto phase = Checks<D>::built(empty, make_scene<D>(Scene::uniform, 100, random));
    const auto boxes = make_scene<D>(Scene::line, 40, random);
    phase.build(boxes);
    Checks<D>::check(phase, boxes, random);
    phase.build({});
    EXPECT_TRUE(phase.empty());
    EXPECT_EQ(phase.bounds(), Aabb<D>::empty());
    Checks<D>::check(phase, {}, random);
}
TYPED_TEST(BroadPhases, BuildAgainForgetsTheOldBoxes) {
    build_again_forgets_the_old_boxes(this->empty);
}

template <int D>
void have_the_same_order_every_time(const AnyBroadPhase<D>& empty) {
    const auto history = [](auto& phase) {
        oracle::Random random(21);
        auto boxes = make_scene<D>(Scene::uniform, 400, random);
        phase.build(boxes);
        std::vector<std::uint32_t> order;
        for (int frame = 0; frame < 20; ++frame) {
            move_some(boxes, random);
            phase.update(boxes);
            phase.each_pair([&](std::uint32_t i, std::uint32_t j) { order.insert(order.end(), {i, j}); });
            phase.each_overlapping(boxes[3], [&](std::uint32_t i) { order.push_back(i); });
            phase.raycast(Ray<D>{Vec<D>(-9), Vec<D>(axis<D>(0))}, [&](std::uint32_t i) { order.push_back(i); });
            phase.closest(
                Vec<D>(2), [&](std::uint32_t i) { order.push_back(i); }, 5.0f);
        }
        return order;
    };
    AnyBroadPhase<D> fresh = empty, used = Checks<D>::built(empty, std::vector<Aabb<D>>(77));
    EXPECT_EQ(history(fresh), history(used));
}
TYPED_TEST(BroadPhases, HaveTheSameOrderEveryTime) {
    have_the_same_order_every_time(this->empty);
}

template <int D>
void pairs_of_four_boxes(const AnyBroadPhase<D>& empty) {
    // 0 touches 1 at a face and 2 lies in 1; 3 is an ulp away from 1.
    std::vector<Aabb<D>> boxes{
        {Vec<D>(0), Vec<D>(1)}, {Vec<D>(0), Vec<D>(2)}, {Vec<D>(1.25f), Vec<D>(1.5f)}, {Vec<D>(0), Vec<D>(1)}};
    boxes[1].min[0] = 1;
    boxes[3].min[0] = std::nextafter(2.0f, 3.0f);
    boxes[3].max[0] = 3;
    Pairs pairs;
    Checks<D>::built(empty, boxes).sorted_pairs(pairs);
    EXPECT_EQ(pairs, (Pairs{{0, 1}, {1, 2}}));
}
TYPED_TEST(BroadPhases, PairsOfFourBoxes) {
    pairs_of_four_boxes(this->empty);
}

template <int D>
void have_the_same_pairs_with_several_threads(const AnyBroadPhase<D>& empty) {
    ThreadPool executor(3);
    for (const Scene scene : all_scenes)
        for (const std::uint32_t count : {0u, 1u, 7u, 3000u}) {
            SCOPED_TRACE(testing::Message() << "scene " << static_cast<int>(scene) << " of " << count << " seed 31");
            if (scene == Scene::coincident && count > 1000) continue;  // millions of pairs
            oracle::Random random(31);
            auto boxes = make_scene<D>(scene, count, random);
            AnyBroadPhase<D> phase = empty, alone = empty;
            phase.build(boxes, &executor);
            alone.build(boxes);
            for (int frame = 0; frame < 3; ++frame) {
                Pairs expected, found;
                alone.sorted_pairs(expected);
                std::mutex mutex;
                const auto keep = [&](std::uint32_t i, std::uint32_t j) {
                    const std::lock_guard lock(mutex);
                    found.emplace_back(i, j);
                };
                phase.each_pair(keep, &executor);
                detail::sort_pairs(found);
                EXPECT_EQ(found, expected);
                std::atomic<int> visited_count = 0;
                phase.each_pair([&](std::uint32_t, std::uint32_t) { return ++visited_count, false; }, &executor);
                EXPECT_EQ(visited_count > 0, !expected.empty());
                move_some(boxes, random);
                phase.update(boxes, &executor);
                alone.update(boxes);
            }
        }
}
TYPED_TEST(BroadPhases, HaveTheSamePairsWithSeveralThreads) {
    have_the_same_pairs_with_several_threads(this->empty);
}

/// A visitor that stops one part of the work stops all: no thread begins another part, and running parts end with their
/// current batch.
template <int D>
void other_threads_stop_soon_after_one_has_enough(const AnyBroadPhase<D>& empty) {
    oracle::Random random(41);
    const auto boxes = make_scene<D>(Scene::uniform, 20000, random);
    const auto phase = Checks<D>::built(empty, boxes);
    ThreadPool executor(3);
    std::atomic<std::size_t> all = 0, visited_count = 0;
    phase.each_pair([&](std::uint32_t, std::uint32_t) { ++all; }, &executor);
    EXPECT_GT(all, 10000u);
    // A later call returns true again, so that only the first false stops the other threads.
    phase.each_pair([&](std::uint32_t, std::uint32_t) { return ++visited_count != 100; }, &executor);
    EXPECT_GE(visited_count, 100u);
    EXPECT_LT(visited_count, all / 2);
}
TYPED_TEST(BroadPhases, OtherThreadsStopSoonAfterOneHasEnough) {
    other_threads_stop_soon_after_one_has_enough(this->empty);
}

template <int D>
void endless_boxes_pair_with_all_they_touch(const AnyBroadPhase<D>& empty) {
    constexpr float far = std::numeric_limits<float>::infinity();
    std::vector<Aabb<D>> boxes{{Vec<D>(0), Vec<D>(1)},
                               {Vec<D>(-far), Vec<D>(far)},  // the whole space
                               {Vec<D>(-far), Vec<D>(far)},  // the half-space below 0 on the last axis
                               Aabb<D>::empty(),
                               {Vec<D>(5), Vec<D>(6)}};
    boxes[2].max[D - 1] = 0;
    const auto phase = Checks<D>::built(empty, boxes);
    Pairs pairs;
    phase.sorted_pairs(pairs);
    EXPECT_EQ(pairs, (Pairs{{0, 1}, {0, 2}, {1, 2}, {1, 4}}));
    EXPECT_EQ(Checks<D>::overlapping(phase, boxes[1]), (Items{0, 1, 2, 4}));
    EXPECT_EQ(Checks<D>::along(phase, Ray<D>{Vec<D>(0.5f), Vec<D>(axis<D>(0))}), (Items{0, 1}));
    EXPECT_EQ(Checks<D>::along(phase, Ray<D>{Vec<D>(9), Vec<D>(axis<D>(D - 1, -1))}), (Items{1, 2}));
    EXPECT_EQ(phase.bounds(), boxes[1]);
}
TYPED_TEST(BroadPhases, EndlessBoxesPairWithAllTheyTouch) {
    endless_boxes_pair_with_all_they_touch(this->empty);
}

template <int D>
void stop_when_the_visitor_has_enough(const AnyBroadPhase<D>& empty) {
    const auto phase = Checks<D>::built(empty, std::vector<Aabb<D>>(20, {Vec<D>(0), Vec<D>(1)}));
    const Ray<D> ray{Vec<D>(0.5f), Vec<D>(axis<D>(0))};  // starts in all boxes, so a reach of 0 would not stop it
    for (int enough = 1; enough < 15; ++enough) {
        int pairs = 0, others = 0, boxes = 0, hits = 0, near = 0, pulled_in = 0, all = 0;
        phase.each_pair([&](std::uint32_t, std::uint32_t) { return ++pairs < enough; });
        phase.each_overlapping_pair(phase, [&](std::uint32_t, std::uint32_t) { return ++others < enough; });
        phase.each_overlapping({Vec<D>(0), Vec<D>(1)}, [&](std::uint32_t) { return ++boxes < enough; });
        phase.raycast(ray, [&](std::uint32_t) { return ++hits < enough; });
        phase.closest(Vec<D>(0.5f), [&](std::uint32_t) { return ++near < enough; });
        phase.closest(Vec<D>(9), [&](std::uint32_t) { return ++pulled_in < enough ? 100.0f : 1.0f; });
        phase.each_box([&](std::uint32_t, const Aabb<D>&) { return ++all < enough; });
        EXPECT_EQ(std::tie(pairs, others, boxes, hits, near, pulled_in, all),
                  std::tie(enough, enough, enough, enough, enough, enough, enough));
    }
}
TYPED_TEST(BroadPhases, StopWhenTheVisitorHasEnough) {
    stop_when_the_visitor_has_enough(this->empty);
}

template <int D>
void the_reach_only_shrinks(const AnyBroadPhase<D>& empty) {
    std::vector<Aabb<D>> boxes;
    for (int i = 0; i < 10; ++i) boxes.push_back(box_at<D>(axis<D>(0) * (2.0 * i), DVec<D>(0.5)));
    const auto phase = Checks<D>::built(empty, boxes);
    constexpr float far = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const float answer : {far, nan, 1000.0f}) {
        int near = 0, hits = 0;
        phase.closest(
            Vec<D>(0), [&](std::uint32_t) { return ++near, answer; }, 3.5f);
        phase.raycast(Ray<D>{Vec<D>(0), Vec<D>(axis<D>(0)), 3.5f}, [&](std::uint32_t) { return ++hits, answer; });
        EXPECT_EQ(near, 3);
        EXPECT_EQ(hits, 3);
    }
    // At reach 0, boxes that touch the point are still visited.
    std::vector<Aabb<D>> touching(7, {Vec<D>(0), Vec<D>(1)});
    const auto corner = Checks<D>::built(empty, touching);
    int near = 0, hits = 0;
    corner.closest(Vec<D>(1), [&](std::uint32_t) { return ++near, 0.0f; });
    corner.raycast(Ray<D>{Vec<D>(1), Vec<D>(axis<D>(0))}, [&](std::uint32_t) { return ++hits, 0.0f; });
    EXPECT_EQ(near, 7);
    EXPECT_EQ(hits, 7);
}
TYPED_TEST(BroadPhases, TheReachOnlyShrinks) {
    the_reach_only_shrinks(this->empty);
}

template <int D>
void equal_distances_all_come(const AnyBroadPhase<D>& empty) {
    // Half of all distances are rounded down to float; the next item must still be visited.
    for (int step = 1; step < 50; ++step) {
        const Vec<D> corner(0.37f * static_cast<float>(step));
        const auto phase = Checks<D>::built(empty, std::vector<Aabb<D>>(9, {corner, corner + Vec<D>(1)}));
        const float distance = static_cast<float>(length(DVec<D>(corner)));
        int near = 0, hits = 0;
        phase.closest(Vec<D>(0), [&](std::uint32_t) { return ++near, distance; });
        const Ray<D> ray = Ray<D>::between(Vec<D>(0), corner + Vec<D>(0.5f));
        phase.raycast(ray, [&](std::uint32_t) { return ++hits, distance; });
        EXPECT_EQ(near, 9) << step;
        EXPECT_EQ(hits, 9) << step;
    }
}
TYPED_TEST(BroadPhases, EqualDistancesAllCome) {
    equal_distances_all_come(this->empty);
}

template <int D>
void closest_to_a_box(const AnyBroadPhase<D>& empty) {
    oracle::Random random(3);
    const auto boxes = make_scene<D>(Scene::uniform, 300, random);
    const auto phase = Checks<D>::built(empty, boxes);
    int found = 0;
    for (int repeat = 0; repeat < 100; ++repeat) {
        const Aabb<D> box = some_box<D>(random, 30, 3);
        Items near, grown_by_it;
        phase.closest(
            box, [&](std::uint32_t i) { near.push_back(i); }, 2.0f);
        phase.each_overlapping(grown(box, 2.00001f), [&](std::uint32_t i) {
            // The corner of a box grown by 2 is farther than 2 from the box.
            DVec<D> gap;
            for (int a = 0; a < D; ++a)
                gap[a] = std::max({0.0f, boxes[i].min[a] - box.max[a], box.min[a] - boxes[i].max[a]});
            if (length(gap) <= 2.000001) grown_by_it.push_back(i);
        });
        std::sort(near.begin(), near.end());
        std::sort(grown_by_it.begin(), grown_by_it.end());
        EXPECT_EQ(near, grown_by_it) << "seed 3, repeat " << repeat;
        found += static_cast<int>(near.size());
    }
    EXPECT_GT(found, 100);
}
TYPED_TEST(BroadPhases, ClosestToABox) {
    closest_to_a_box(this->empty);
}

template <int D>
void take_visitors_that_are_const_or_move_only(const AnyBroadPhase<D>& empty) {
    const auto phase = Checks<D>::built(empty, std::vector<Aabb<D>>(3, {Vec<D>(0), Vec<D>(1)}));
    int calls = 0;
    const auto count = [&calls](std::uint32_t) { ++calls; };
    phase.each_overlapping(phase.bounds(), count);
    auto owned = [count = std::make_unique<int>(0)](std::uint32_t) mutable { return ++*count < 2; };
    phase.each_overlapping(phase.bounds(), owned);
    phase.closest(Vec<D>(0), count);
    EXPECT_EQ(calls, 6);
    EXPECT_FALSE(owned(0)) << "a visitor is used, not copied";
}
TYPED_TEST(BroadPhases, TakeVisitorsThatAreConstOrMoveOnly) {
    take_visitors_that_are_const_or_move_only(this->empty);
}

}  // namespace
}  // namespace abut::test
