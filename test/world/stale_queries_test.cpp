// The cost of queries before the next update is at most twice the cost after it. A shape counts the calls of its
// support function as the measure of cost.

#include "support/bits.hpp"
#include "support/simulation.hpp"

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

std::atomic<std::size_t> support_calls = 0;

/// A ball with a support function alone, which counts its calls.
template <int D>
struct CountingBall {
    float radius = 0.25f;
};

template <int D>
Aabb<D> bounds(const CountingBall<D>& shape) {
    return {Vec<D>(-shape.radius), Vec<D>(shape.radius)};
}

template <int D>
Vec<D> support(const CountingBall<D>& shape, const Vec<D>& direction) {
    ++support_calls;
    return to_float(normalized(DVec<D>(direction)) * static_cast<double>(shape.radius));
}

template <int D>
class Crowd {
public:
    explicit Crowd(const WorldOptions& options = {}) : world(options) {}

    Pose<D> any_pose() { return {to_float(random.in_cube<D>() * extent)}; }
    void add() { ids.push_back(world.add(CountingBall<D>(), {.pose = any_pose(), .fixed = ids.size() % 4 == 0})); }
    void add_all() {
        while (ids.size() < count) add();
    }
    void move(Id id) {
        Pose<D> pose = world.pose(id);
        // Most balls move a step, some to another place.
        pose = random.chance(0.9) ? Pose<D>{pose.position + 0.2f * to_float(random.in_cube<D>())} : any_pose();
        world.move(id, pose);
    }
    void query() {
        const Vec<D> from = any_pose().position, to = any_pose().position;
        world.raycast(Ray<D>::between(from, to));
        world.raycast_any(Ray<D>::between(from, to));
        world.sweep(Ball<D>{from, 0.1f}, to - from);
        world.closest(from);
        world.closest(Ball<D>{to, 0.1f});
        world.overlapping(Ball<D>{to, 0.5f});
        world.containing(to);
    }
    /// The mean number of support calls of a query, with `before` run before each.
    double calls_per_query(const std::function<void(std::size_t)>& before) {
        support_calls = 0;
        for (std::size_t i = 0; i < count; ++i) {
            before(i);
            query();
        }
        return static_cast<double>(support_calls) / static_cast<double>(count);
    }

    static constexpr std::size_t count = 300;
    static constexpr double extent = D == 2 ? 11 : 4;
    oracle::Random random{D};
    World<D> world;
    std::vector<Id> ids;
};

// Regression: seven queries called the supports of 300 moved balls 8833 times in 2D and 11722 times in 3D, against 520
// and 452 times after an update.
template <int D>
void expect_work_of_settled_queries(const WorldOptions& options) {
    Crowd<D> crowd(options);
    crowd.add_all();
    crowd.world.update();
    const double settled = crowd.calls_per_query([](std::size_t) {});
    EXPECT_GT(settled, 1);
    const auto expect = [&](const std::string& what, const std::function<void(std::size_t)>& before) {
        EXPECT_LT(crowd.calls_per_query(before), 2 * settled) << what;
    };
    for (const Id id : crowd.ids) crowd.move(id);
    expect("all moved", [](std::size_t) {});
    crowd.world.update();
    expect("one moved before each", [&](std::size_t i) { crowd.move(crowd.ids[i]); });
    expect("the same one moved before each", [&](std::size_t) { crowd.move(crowd.ids[0]); });
    expect("a shape changed before each",
           [&](std::size_t i) { crowd.world.set_shape(crowd.ids[i], CountingBall<D>{0.3f}); });
    expect("one removed before each", [&](std::size_t i) { crowd.world.remove(crowd.ids[i]); });
    crowd.ids.clear();
    expect("one added before each", [&](std::size_t) { crowd.add(); });
    crowd.world.update();
    EXPECT_EQ(crowd.world.size(), crowd.count);
}

TEST(StaleQueries, CostWhatSettledOnesDo) {
    for (const std::optional<BroadPhaseKind> kind :
         {std::optional<BroadPhaseKind>(), std::optional(BroadPhaseKind::bvh)}) {
        SCOPED_TRACE("broad phase " + std::to_string(kind ? static_cast<int>(*kind) : -1));
        expect_work_of_settled_queries<2>({.broad_phase = kind});
        expect_work_of_settled_queries<3>({.broad_phase = kind});
    }
}

template <int D>
Bits stale_answers(const World<D>& world, std::uint64_t seed) {
    oracle::Random random(seed);
    Bits result;
    for (int i = 0; i < 10; ++i) {
        const Vec<D> from = to_float(random.in_cube<D>() * Crowd<D>::extent),
                     to = to_float(random.in_cube<D>() * Crowd<D>::extent);
        result.put(world.raycast_all(Ray<D>::between(from, to)));
        result.put(world.sweep(Ball<D>{from, 0.1f}, to - from));
        result.put(world.closest(from));
        result.put(world.overlapping(Ball<D>{to, 1}));
        result.put(world.containing(to));
    }
    return result;
}

/// Several threads send the first query after all items moved; one of them does the deferred work.
template <int D>
void query_first_from_many_threads(BroadPhaseKind kind) {
    Crowd<D> crowd({.broad_phase = kind}), twin({.broad_phase = kind});
    constexpr std::uint64_t threads = 4;
    for (int round = 0; round < 20; ++round) {
        for (Crowd<D>* each : {&crowd, &twin}) {
            for (int i = 0; i < 20; ++i) each->add();
            for (const Id id : each->ids)
                if (round % 2 == 0 || id.index % 32 == 0) each->move(id);
            if (round % 4 == 1) each->world.update();
        }
        twin.world.refresh();
        std::vector<Bits> expected(threads), found(threads);
        for (std::uint64_t i = 0; i < threads; ++i) expected[i] = stale_answers(twin.world, i);
        std::vector<std::thread> running;
        for (std::uint64_t i = 0; i < threads; ++i)
            running.emplace_back([&, i] { found[i] = stale_answers(std::as_const(crowd.world), i); });
        for (std::thread& thread : running) thread.join();
        EXPECT_EQ(found, expected);
    }
}

TEST(StaleQueries, AnswerAllThreadsAlike) {
    for (const BroadPhaseKind kind : {BroadPhaseKind::bvh, BroadPhaseKind::grid}) {
        query_first_from_many_threads<2>(kind);
        query_first_from_many_threads<3>(kind);
    }
}

template <int D>
void put_update(World<D>& world, Bits& result) {
    const Events events = world.update();
    result.put(events.began);
    result.put(events.stayed);
    result.put(events.ended);
    result.put(events.fractions);
    result.put(world.contacts());
}

/// Plays two games of one seed, one of which calls refresh() sometimes.
template <int D>
void expect_same_with_refresh(std::uint64_t seed, double continuous) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation<D> plain(seed, 60, false, {}, continuous), refreshed(seed, 60, false, {}, continuous);
    oracle::Random random(seed);
    std::size_t began = 0;
    for (int frame = 0; frame < 60; ++frame) {
        Bits one, other;
        put_update(plain.world, one);
        put_update(refreshed.world, other);
        ASSERT_EQ(one, other) << "frame " << frame;
        began += plain.world.contacts().size();
        for (std::uint32_t changes = random.below(3); changes > 0; --changes) {
            plain.change();
            refreshed.change();
            if (random.chance(0.7)) refreshed.world.refresh();
            const std::uint64_t at = random.below(1000);
            ASSERT_EQ(stale_answers(plain.world, at), stale_answers(refreshed.world, at));
        }
        if (random.chance(0.3)) refreshed.world.refresh();
    }
    EXPECT_GT(began, 100u);
}

TEST(Refresh, ChangesNoEventAndNoAnswer) {
    expect_same_with_refresh<2>(31, 0);
    expect_same_with_refresh<3>(32, 0);
    expect_same_with_refresh<2>(33, 0.5);
    expect_same_with_refresh<3>(34, 0.5);
}

}  // namespace
}  // namespace abut::test
