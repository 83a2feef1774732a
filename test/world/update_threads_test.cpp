// An update on several threads: the same events, contacts, impacts and later states as on one, bit by bit, with any
// executor.

#include "../broad_phase/allocations.hpp"
#include "support/bits.hpp"
#include "support/simulation.hpp"
#include <abut/math/thread_pool.hpp>

#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Runs the parts on the calling thread, the last one first.
class Backwards final : public Executor {
public:
    explicit Backwards(std::uint32_t workers) : workers_(workers) {}
    std::uint32_t workers() const override { return workers_; }
    void run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) override {
        max_count = std::max(max_count, count);
        for (std::uint32_t i = count; i-- > 0;) part(i);
    }

    std::uint32_t max_count = 0;

private:
    std::uint32_t workers_;
};

template <int D>
Bits updated(World<D>& world, Executor* executor) {
    const Events events = executor != nullptr ? world.update(*executor) : world.update();
    Bits result;
    result.put(events.began);
    result.put(events.stayed);
    result.put(events.ended);
    for (const float fraction : events.fractions) result.put(fraction);
    result.put(world.contacts());
    result.put(world.impacts());
    result.put(static_cast<std::uint32_t>(world.counts().near));
    result.put(static_cast<std::uint32_t>(world.counts().tested));
    return result;
}

/// Plays the same game once for each executor, the first time without any. In the middle, the world goes on from a
/// snapshot and as a copy.
template <int D>
void expect_equal_games(std::uint64_t seed, double continuous) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ThreadPool one(1), two(2), three(3), four(4);
    Backwards backwards(3);
    const std::vector<Executor*> executors{nullptr, &one, &two, &three, &four, &backwards};
    const WorldOptions options{.filter_edges = seed % 5 != 0};
    std::vector<Simulation<D>> games;
    for (std::size_t i = 0; i < executors.size(); ++i) {
        games.emplace_back(seed, 150, seed % 2 == 0, options, continuous);
        games.back().with_all = true;
    }
    std::size_t impacts = 0;
    for (int frame = 0; frame < 12; ++frame) {
        std::vector<Bits> found;
        for (std::size_t i = 0; i < executors.size(); ++i) {
            games[i].change();
            if (frame == 5) {
                ASSERT_FALSE(games[i].world.restore(games[i].world.save()));
            }
            if (frame == 8) games[i].world = World<D>(games[i].world);
            found.push_back(updated(games[i].world, executors[i]));
            ASSERT_EQ(found.back(), found.front()) << i << " frame " << frame;
            ASSERT_EQ(games[i].world.save(), games.front().world.save()) << i << " frame " << frame;
        }
        impacts += games.front().world.impacts().size();
    }
    EXPECT_GT(backwards.max_count, 4u) << "there were several parts";
    EXPECT_EQ(impacts > 0, continuous > 0);
    EXPECT_GT(games.front().world.contacts().size(), 20u);
}

TEST(UpdateThreads, GiveTheSameBits) {
    for (std::uint64_t seed = 700; seed < 706; ++seed) {
        expect_equal_games<2>(seed, seed % 3 == 0 ? 0.2 : 0);
        expect_equal_games<3>(seed, seed % 3 == 0 ? 0.2 : 0);
    }
}

TEST(UpdateThreads, AllocateNothingOnceWarm) {
    if (!counts_allocations()) GTEST_SKIP() << "not in builds with sanitizers";
    ThreadPool pool(3);
    Simulation<3> game(7, 150);
    const std::vector<Id> ids = game.all_ids();
    std::size_t counted = 0;
    for (int lap = 0; lap < 3; ++lap) {
        oracle::Random random(8);
        counted = 0;
        for (int frame = 0; frame < 20; ++frame) {
            for (const Id id : ids) game.world.move(id, random_pose<3>(random, 2.5));
            const std::size_t before = allocations();
            game.world.update(pool);
            counted += allocations() - before;
        }
        if (lap == 0) {
            EXPECT_GT(counted, 0u);
        }
    }
    EXPECT_EQ(counted, 0u);
}

}  // namespace
}  // namespace abut::test
