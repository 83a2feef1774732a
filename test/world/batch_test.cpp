// Many changes and questions in one call: each answer is that of the question alone, with and without threads.

#include "../broad_phase/allocations.hpp"
#include "support/bits.hpp"
#include "support/simulation.hpp"
#include <abut/math/thread_pool.hpp>

#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

template <class Answer>
Bits bits_of(const std::vector<std::optional<Answer>>& answers) {
    Bits result;
    for (const std::optional<Answer>& answer : answers) result.put(answer);
    return result;
}

template <class T>
class Batch : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Batch, Dimensions);

TYPED_TEST(Batch, AnswersAreThoseOfEachQuestion) {
    constexpr int D = TypeParam::value;
    Simulation<D> game(7, 60);
    game.world.update();
    game.change();  // so that the first question brings the broad phases up to date
    const World<D>& world = game.world;
    oracle::Random random(7);
    std::vector<Vec<D>> points;
    std::vector<Ray<D>> rays;
    // More than a part for each thread, and a last part that isn't full.
    for (int i = 0; i < 500; ++i) {
        points.push_back(to_float(random.in_cube<D>() * 4.0));
        rays.push_back(Ray<D>::between(points.back(), to_float(random.in_cube<D>() * 4.0)));
    }
    const Filter filter{.mask = 1, .sensors = true};
    std::vector<std::optional<WorldHit<D>>> hits(rays.size()), expected_hits;
    std::vector<std::optional<WorldClosest<D>>> closest(points.size()), expected_closest;
    ThreadPool pool(3);
    world.raycast(rays, hits, pool, filter);
    world.closest(points, closest, pool, filter);
    for (const Ray<D>& ray : rays) expected_hits.push_back(world.raycast(ray, filter));
    for (const Vec<D>& point : points) expected_closest.push_back(world.closest(point, filter));
    EXPECT_EQ(bits_of(hits), bits_of(expected_hits));
    EXPECT_EQ(bits_of(closest), bits_of(expected_closest));

    world.raycast(rays, hits, filter);
    world.closest(points, closest, filter);
    EXPECT_EQ(bits_of(hits), bits_of(expected_hits));
    EXPECT_EQ(bits_of(closest), bits_of(expected_closest));

    world.raycast(std::span<const Ray<D>>(), {}, pool);
}

TYPED_TEST(Batch, MovesAreThoseOfEachItem) {
    constexpr int D = TypeParam::value;
    World<D> one_by_one, together;
    oracle::Random random(8);
    std::vector<Id> ids;
    for (int i = 0; i < 50; ++i) {
        const Pose<D> pose{to_float(random.in_cube<D>() * 3.0), random.rotation<D>()};
        ids.push_back(one_by_one.add(Box<D>{Vec<D>(0.0f), Vec<D>(0.5f)}, {.pose = pose}));
        together.add(Box<D>{Vec<D>(0.0f), Vec<D>(0.5f)}, {.pose = pose});
    }
    one_by_one.update();
    together.update();
    std::vector<Pose<D>> poses;
    for (const Id id : ids) {
        poses.push_back({to_float(random.in_cube<D>() * 3.0), random.rotation<D>()});
        one_by_one.move(id, poses.back());
    }
    together.move(ids, poses);
    EXPECT_EQ(together.save(), one_by_one.save());
    const Events expected = one_by_one.update(), events = together.update();
    EXPECT_TRUE(std::equal(events.began.begin(), events.began.end(), expected.began.begin(), expected.began.end()));
    EXPECT_EQ(together.save(), one_by_one.save());
}

/// Checks all questions about a shape at once, on one thread and on several, against each alone.
template <int D, class S>
void check_shape(const World<D>& world, const S& shape, const std::vector<Pose<D>>& poses,
                 const std::vector<Motion<D>>& motions, const Filter& filter, Executor& executor) {
    std::vector<std::optional<WorldHit<D>>> hits(motions.size()), expected_hits;
    std::vector<std::optional<WorldClosest<D>>> closest(poses.size()), expected_closest;
    std::vector<std::vector<Id>> expected_ids;
    for (const Motion<D>& motion : motions) expected_hits.push_back(world.sweep(shape, motion, filter));
    for (const Pose<D>& pose : poses) {
        expected_closest.push_back(world.closest(at(shape, pose), filter));
        expected_ids.push_back(world.overlapping(at(shape, pose), filter));
    }
    IdLists lists;
    const auto check = [&] {
        EXPECT_EQ(bits_of(hits), bits_of(expected_hits));
        EXPECT_EQ(bits_of(closest), bits_of(expected_closest));
        ASSERT_EQ(lists.size(), poses.size());
        std::vector<Id> all;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            EXPECT_EQ(std::vector<Id>(lists[i].begin(), lists[i].end()), expected_ids[i]);
            all.insert(all.end(), expected_ids[i].begin(), expected_ids[i].end());
        }
        EXPECT_EQ(std::vector<Id>(lists.all().begin(), lists.all().end()), all);
        hits.assign(hits.size(), {});
        closest.assign(closest.size(), {});
    };
    world.sweep(shape, motions, hits, executor, filter);
    world.closest(shape, poses, closest, executor, filter);
    world.overlapping(shape, poses, lists, executor, filter);
    check();
    world.sweep(shape, motions, hits, filter);
    world.closest(shape, poses, closest, filter);
    world.overlapping(shape, poses, lists, filter);
    check();
}

TYPED_TEST(Batch, AnswersForOneShapeAreThoseOfEachQuestion) {
    constexpr int D = TypeParam::value;
    Simulation<D> game(9, 60);
    game.with_all = true;
    game.world.update();
    game.change();
    ThreadPool pool(3);
    for (int round = 0; round < 6; ++round) {
        SCOPED_TRACE("round " + std::to_string(round));
        std::vector<Pose<D>> poses;
        std::vector<Motion<D>> motions;
        for (int i = 0; i < 150; ++i) {
            poses.push_back(game.any_pose());
            motions.push_back(Motion<D>::between(poses.back(), game.any_pose()));
        }
        const Filter filter = game.filter();
        game.with_any_shape([&](const auto& shape) { check_shape(game.world, shape, poses, motions, filter, pool); });
    }
    IdLists lists;
    game.world.overlapping(Ball<D>{}, std::span<const Pose<D>>(), lists, pool);
    EXPECT_EQ(lists.size(), 0u);
}

/// A world in which questions are answered in spatial order.
template <int D>
World<D> large_world(oracle::Random& random, double extent) {
    World<D> world;
    std::vector<ItemOptions<D>> options(std::size_t{1} << 15);
    for (ItemOptions<D>& option : options) {
        option.pose = {to_float(random.in_cube<D>() * extent), random.rotation<D>()};
        option.fixed = random.chance(0.5);
    }
    std::vector<Id> ids(options.size());
    world.add(Box<D>{Vec<D>(0.0f), Vec<D>(0.5f)}, options, ids);
    return world;
}

TYPED_TEST(Batch, AnswersInSpatialOrderAreThoseOfEachQuestion) {
    constexpr int D = TypeParam::value;
    constexpr double extent = D == 2 ? 150 : 25;
    oracle::Random random(10);
    const World<D> world = large_world<D>(random, extent);
    std::vector<Pose<D>> poses;
    std::vector<Motion<D>> motions;
    std::vector<Vec<D>> points;
    for (int i = 0; i < 1100; ++i) {
        // Several at one place, and some in a plane.
        const DVec<D> place = i % 10 == 0 ? DVec<D>(1.0) : random.in_cube<D>() * extent;
        poses.push_back({to_float(place), random.rotation<D>()});
        points.push_back(poses.back().position);
        motions.push_back(Motion<D>::between(poses.back(), {points.back() + to_float(random.in_cube<D>() * 4.0)}));
    }
    ThreadPool pool(2);
    check_shape(world, Ball<D>{Vec<D>(0.1f), 1}, poses, motions, {}, pool);
    std::vector<std::optional<WorldClosest<D>>> closest(points.size()), expected;
    for (const Vec<D>& point : points) expected.push_back(world.closest(point));
    world.closest(points, closest);
    EXPECT_EQ(bits_of(closest), bits_of(expected));
    world.closest(points, closest, pool);
    EXPECT_EQ(bits_of(closest), bits_of(expected));
}

/// Two worlds of one history: one that changes one by one, one that changes in batches.
template <int D>
struct Twins {
    template <class S>
    void add(const S& shape, const std::vector<ItemOptions<D>>& options) {
        std::vector<Id> added(options.size()), expected;
        together.add(shape, options, added);
        for (const ItemOptions<D>& each : options) expected.push_back(one_by_one.add(shape, each));
        ASSERT_EQ(added, expected);
        ids.insert(ids.end(), added.begin(), added.end());
    }
    void expect_equal() {
        ASSERT_EQ(together.save(), one_by_one.save());
        oracle::Random points(ids.size());
        for (int i = 0; i < 20; ++i) {
            const Ball<D> ball{to_float(points.in_cube<D>() * 3.0), 0.5f};
            ASSERT_EQ(together.overlapping(ball), one_by_one.overlapping(ball));
        }
    }

    World<D> one_by_one, together;
    std::vector<Id> ids;
};

TYPED_TEST(Batch, AddedAndRemovedItemsAreThoseOfOneByOne) {
    constexpr int D = TypeParam::value;
    for (const std::uint64_t seed : {21u, 22u, 23u}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        oracle::Random random(seed);
        Twins<D> twins;
        for (int round = 0; round < 30; ++round) {
            std::vector<ItemOptions<D>> options(random.below(random.chance(0.3) ? 300 : 12));
            for (ItemOptions<D>& each : options)
                each = {.pose = random_pose<D>(random, 3),
                        .user = random.bits(),
                        .fixed = random.chance(0.3),
                        .continuous = random.chance(0.05),
                        .enabled = random.chance(0.9)};
            with_random_shape<D>(random, random_kind<D>(random), [&](const auto& shape) { twins.add(shape, options); });
            if (random.chance(0.5)) {
                ASSERT_NO_FATAL_FAILURE(twins.expect_equal());
            }
            std::vector<Id> removed;
            std::erase_if(twins.ids, [&](Id id) {
                if (!random.chance(0.4)) return false;
                removed.push_back(id);
                return true;
            });
            for (std::size_t i = removed.size(); i > 1; --i)
                std::swap(removed[i - 1], removed[random.below(static_cast<std::uint32_t>(i))]);
            twins.together.remove(removed);
            for (const Id id : removed) twins.one_by_one.remove(id);
            if (random.chance(0.5)) {
                ASSERT_NO_FATAL_FAILURE(twins.expect_equal());
            }
            if (random.chance(0.3)) {
                twins.together.update();
                twins.one_by_one.update();
            }
        }
        ASSERT_NO_FATAL_FAILURE(twins.expect_equal());
    }
}

TEST(BatchMemory, QuestionsAllocateNothingOnceWarm) {
    if (!counts_allocations()) GTEST_SKIP() << "not in builds with sanitizers";
    Simulation<3> game(24, 60);
    game.world.update();
    const World3& world = game.world;
    std::vector<Pose3> poses;
    std::vector<Motion3> motions;
    for (int i = 0; i < 300; ++i) {
        poses.push_back(game.any_pose());
        motions.push_back(Motion3::between(poses.back(), game.any_pose()));
    }
    std::vector<std::optional<WorldHit<3>>> hits(motions.size());
    std::vector<std::optional<WorldClosest<3>>> closest(poses.size());
    IdLists lists;
    ThreadPool pool(2);
    const Box3 box{{0, 0, 0}, {0.5f, 0.5f, 0.5f}};
    for (const bool warm : {false, true}) {
        const std::size_t before = allocations();
        world.sweep(box, motions, hits);
        world.closest(box, poses, closest);
        world.overlapping(box, poses, lists);
        world.overlapping(box, poses, lists, pool);
        const std::size_t made = allocations() - before;
        EXPECT_EQ(made == 0, warm);
    }
    EXPECT_GT(lists.all().size(), 100u);
}

TEST(BatchMemory, ManyItemsShareOneShape) {
    World2 world;
    const std::vector<ItemOptions<2>> options(1000);
    std::vector<Id> ids(options.size());
    const std::size_t before = allocations();
    world.add(Circle{{0, 0}, 1}, options, ids);
    EXPECT_LT(allocations() - before, 20u);
    EXPECT_TRUE(world.any_shape(ids.front()).is_shared_with(world.any_shape(ids.back())));
}

}  // namespace
}  // namespace abut::test
