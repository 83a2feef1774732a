// Many motions and questions in one call: each answer is that of the question alone, with and without threads.

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

}  // namespace
}  // namespace abut::test
