// A million random operations (a few ten thousand unless ABUT_LONG is set) on a world and on the reference
// implementation, which tests every pair: changes, updates, questions, snapshots, copies and the past. A difference is
// shown with a short sequence of operations that leads to it.

#include "../oracle/is_long.hpp"
#include "../world/support/game.hpp"

#include <iostream>

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Seeds = std::vector<std::uint64_t>;

/// What a game showed: the first failure, if any, and what was done until then.
struct Played {
    std::string failure;
    std::vector<std::string> steps;
    int reused = 0, edited = 0, restored = 0, asked_past = 0, ghosts = 0, covered = 0;
    bool fresh_ids = true;
};

/// Plays until an operation fails.
template <int D>
Played play(const Scene& scene, const Seeds& seeds, Executor& executor, Seen& seen) {
    testing::TestPartResultArray failures;
    const testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
    Game<D> game(scene, executor, seen);
    Played result;
    for (std::size_t i = 0; i < seeds.size() && failures.size() == 0; ++i) result.steps.push_back(game.step(seeds[i]));
    if (failures.size() > 0) {
        const testing::TestPartResult& first = failures.GetTestPartResult(0);
        result.failure = std::string(first.file_name()) + ":" + std::to_string(first.line_number()) + ": " +
                         std::string(first.message()).substr(0, 2000);
    }
    const Simulation<D>& game_of = game.simulation();
    result.reused = game_of.reused;
    result.fresh_ids = game_of.fresh_ids;
    result.ghosts = static_cast<int>(game_of.reference.ghosts);
    result.covered = static_cast<int>(game_of.reference.covered);
    result.edited = game.edited;
    result.restored = game.restored;
    result.asked_past = game.asked_past;
    return result;
}

/// Leaves out operations, at first many at once, as long as one still fails.
template <int D>
Played shortest(const Scene& scene, Seeds seeds, Executor& executor) {
    Seen seen;
    Played best = play<D>(scene, seeds, executor, seen);
    seeds.resize(best.steps.size());
    for (std::size_t chunk = seeds.size() / 2; chunk > 0; chunk /= 2)
        for (std::size_t from = 0; from < seeds.size();) {
            Seeds fewer = seeds;
            const auto first = fewer.begin() + static_cast<std::ptrdiff_t>(from);
            fewer.erase(first, first + static_cast<std::ptrdiff_t>(std::min(chunk, seeds.size() - from)));
            Played played = play<D>(scene, fewer, executor, seen);
            if (played.failure.empty()) {
                from += chunk;
                continue;
            }
            fewer.resize(played.steps.size());
            seeds = std::move(fewer);
            best = std::move(played);
        }
    return best;
}

template <int D>
void play_or_explain(const Scene& scene, int operations, Executor& executor, Seen& seen) {
    oracle::Random random(scene.seed);
    Seeds seeds;
    while (seeds.size() < static_cast<std::size_t>(operations)) seeds.push_back(random.bits());
    const Played played = play<D>(scene, seeds, executor, seen);
    if (!played.failure.empty()) {
        const Played best = shortest<D>(scene, seeds, executor);
        std::string steps;
        for (const std::string& step : best.steps) steps += "\n  " + step;
        FAIL() << "dimension " << D << ", seed " << scene.seed << ", " << scene.items << " items, lattice "
               << scene.lattice << ", continuous " << scene.continuous << "; operation " << played.steps.size()
               << ", or after " << best.steps.size() << ":" << steps << "\n"
               << best.failure;
    }
    EXPECT_TRUE(played.fresh_ids) << scene.seed;
    seen.reused += played.reused;
    seen.edited += played.edited;
    seen.restored += played.restored;
    seen.past += played.asked_past;
    seen.ghosts += played.ghosts;
    seen.covered += played.covered;
}

/// Plays dense and sparse scenes in turn. Each game is short, so that a failure has a short history.
template <int D>
void play_all(std::uint64_t first_seed, bool lattice, double continuous) {
    constexpr int operations = 1000;
    const int games = oracle::is_long() ? 125 : 4;
    ThreadPool pool(2);
    Seen seen;
    for (int i = 0; i < games; ++i) {
        const Scene scene{first_seed + static_cast<std::uint64_t>(i),
                          std::array{40, 12, 25, 60}[static_cast<std::size_t>(i % 4)], lattice, continuous};
        ASSERT_NO_FATAL_FAILURE(play_or_explain<D>(scene, operations, pool, seen));
    }
    std::cout << games * operations << " operations from seed " << first_seed << ": " << seen << "\n";
    for (const int count :
         {seen.began,        seen.stayed,     seen.ended,        seen.contacts, seen.untested,         seen.hits,
          seen.several_hits, seen.misses,     seen.gaps,         seen.depths,   seen.ghosts,           seen.covered,
          seen.overlapping,  seen.containing, seen.stopped,      seen.touching, seen.several_touching, seen.nearest,
          seen.all_nearest,  seen.sweep_hits, seen.sweep_misses, seen.at_once,  seen.query_contacts,   seen.in_box,
          seen.reused,       seen.edited,     2 * seen.restored, seen.past})
        EXPECT_GT(count, 4 * games);
    if (continuous > 0) {
        EXPECT_GT(std::min(seen.passed, seen.on_the_way - seen.passed), games);
    }
}

TEST(Simulation, Plane) {
    play_all<2>(10'000, false, 0);
}
TEST(Simulation, Space) {
    play_all<3>(20'000, false, 0);
}
TEST(Simulation, PlaneOnALattice) {
    play_all<2>(30'000, true, 0);
}
TEST(Simulation, SpaceOnALattice) {
    play_all<3>(40'000, true, 0);
}
TEST(Simulation, PlaneWithContinuousItems) {
    play_all<2>(50'000, false, 0.3);
}
TEST(Simulation, SpaceWithContinuousItems) {
    play_all<3>(60'000, false, 0.3);
}
TEST(Simulation, PlaneOnALatticeWithContinuousItems) {
    play_all<2>(70'000, true, 1);
}
TEST(Simulation, SpaceOnALatticeWithContinuousItems) {
    play_all<3>(80'000, true, 1);
}

}  // namespace
}  // namespace abut::test
