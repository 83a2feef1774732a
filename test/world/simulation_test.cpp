// A million random operations (a few ten thousand unless ABUT_LONG is set) on a world and on the reference
// implementation, which tests every pair: changes, updates, questions, snapshots, copies and the past. A difference is
// shown with a short sequence of operations that leads to it.

#include "../oracle/is_long.hpp"
#include "support/checks.hpp"
#include <abut/world/history.hpp>

#include <deque>
#include <iostream>

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

struct Scene {
    std::uint64_t seed = 0;
    int items = 30;
    bool lattice = false;
    double continuous = 0;
};

/// A game of which each operation has random numbers of its own, so that it can be played without some of them.
template <int D>
class Game {
public:
    Game(const Scene& scene, Executor& executor, Seen& seen)
        : game_(scene.seed, scene.items, scene.lattice, {.max_released_shapes = 100'000}, scene.continuous),
          executor_(executor),
          seen_(seen) {
        game_.with_all = game_.with_levels = true;
    }

    /// Returns what was done.
    std::string step(std::uint64_t seed) {
        oracle::Random& random = game_.random() = oracle::Random(seed);
        const std::uint32_t number = random.below(100);
        if (number < 40) return change(number);
        if (number < 80) return query(Checks<D>(game_, game_.world, game_.reference, executor_, seen_), number - 40);
        if (number < 90) return update();
        if (number < 93) return save();
        if (number < 94) return restore();
        if (number < 95) return copy();
        if (number < 97) return record();
        return query_past();
    }
    const Simulation<D>& simulation() const { return game_; }

private:
    struct State {
        std::vector<std::byte> bytes;
        ReferenceWorld<D> reference;
        std::set<Id> given;
    };
    /// A copy of the world, and the snapshots whose shapes it has.
    struct Branch {
        Simulation<D> game;
        std::vector<State> states;
    };

    std::string change(std::uint32_t number) {
        oracle::Random& random = game_.random();
        const std::size_t size = game_.reference.items().size();
        if (size < 6 || (number < 3 && size < 50)) {
            game_.add();
            return "add";
        }
        if (number < 4 && size < 50) {
            game_.add_several(random.below(5));
            return "add several";
        }
        const Id id = game_.any_id();
        const auto of_item = [&](const char* what) { return std::string(what) + " " + std::to_string(id.index); };
        switch (number) {
            case 4:
                game_.remove(id);
                return of_item("remove");
            case 5:
                game_.remove_several(any_ids(0.1));
                return "remove several";
            case 6:
                game_.set_shape(id);
                return of_item("set the shape of");
            case 7:
            case 8:
            case 9:
                edited += game_.edit_shape(id) ? 1 : 0;
                return of_item("edit the shape of");
            case 10:
                game_.set_filter(id);
                return of_item("set the filter of");
            case 11:
            case 12:
                game_.set_an_option(id);
                return of_item("set an option of");
            case 13:
                game_.set_pair_filter();
                return "set the pair filter";
            case 14:
            case 15:
                game_.move(id, game_.any_pose());
                return of_item("teleport");
            case 16:
                game_.move(id, game_.world.pose(id));
                return of_item("leave in place");
            case 17:
                game_.world.refresh();
                return "refresh";
            case 18:
            case 19:
            case 20:
            case 21:
            case 22:
            case 23:
                game_.move_several(any_ids(0.5));
                return "move several";
            default:
                game_.move(id, game_.step_from(game_.world.pose(id)));
                return of_item("move");
        }
    }

    std::string query(Checks<D> checks, std::uint32_t number) {
        if (number < 8) return checks.rays(), "rays";
        if (number < 15) return checks.shapes(), "shapes";
        if (number < 22) return checks.points(), "points";
        if (number < 28) return checks.sweeps(), "sweeps";
        if (number < 32) return checks.contacts_of_shapes(), "contacts of a shape";
        if (number < 36) return checks.box(), "a box";
        if (number < 38) return checks.items(), "items";
        return checks.touching(), "touching";
    }

    std::string update() {
        const bool many = game_.random().chance(0.3);
        const Events events = many ? game_.world.update(executor_) : game_.world.update();
        game_.reference.update();
        Checks<D>(game_, game_.world, game_.reference, executor_, seen_).events(events);
        return many ? "update by threads" : "update";
    }

    std::string save() {
        if (states_.size() == 4) states_.erase(states_.begin() + game_.random().below(4));
        states_.push_back({game_.world.save(), game_.reference, game_.given});
        return "save";
    }
    /// Also to a state from before the last one that was restored.
    std::string restore() {
        if (states_.empty()) return "nothing";
        const std::uint32_t i = game_.random().below(static_cast<std::uint32_t>(states_.size()));
        const std::set<Id> given = game_.given;
        const std::optional<Problem> problem = game_.world.restore(states_[i].bytes);
        EXPECT_FALSE(problem) << (problem ? problem->message : "");
        game_.reference.restore(states_[i].reference);
        game_.given = states_[i].given;
        EXPECT_TRUE(game_.world.contacts().empty() && game_.world.impacts().empty());
        EXPECT_EQ(game_.world.save(), states_[i].bytes);
        for (const Id id : given) EXPECT_EQ(game_.world.contains(id), game_.reference.items().contains(id));
        ++restored;
        return "restore " + std::to_string(i);
    }
    /// Goes on with a copy, and keeps the world itself for the next time.
    std::string copy() {
        if (!other_) {
            other_ = Branch{game_, states_};
            return "copy";
        }
        std::swap(other_->game, game_);
        std::swap(other_->states, states_);
        return "change places with the copy";
    }

    std::string record() {
        EXPECT_EQ(past_.record(), recorded_++);
        records_.push_back(game_.reference);
        if (records_.size() > past_ticks) records_.pop_front();
        return "record";
    }
    std::string query_past() {
        if (records_.empty()) return "nothing";
        oracle::Random& random = game_.random();
        const std::uint32_t tick = random.below(static_cast<std::uint32_t>(records_.size()));
        const float fraction = std::array<float, 3>{0, 1, random.uniform_float(0, 1)}[random.below(3)];
        const World<D>& then = past_.at(past_.first_tick() + tick, fraction);
        ReferenceWorld<D> reference = records_[tick];
        if (tick + 1 < records_.size()) reference.move_towards(records_[tick + 1], fraction);
        ++asked_past;
        return "the past: " + query(Checks<D>(game_, then, reference, executor_, seen_), random.below(38));
    }

    std::vector<Id> any_ids(double share) {
        std::vector<Id> ids = game_.all_ids();
        std::erase_if(ids, [&](Id) { return !game_.random().chance(share); });
        return ids;
    }

    static constexpr std::size_t past_ticks = 5;

    Simulation<D> game_;
    Executor& executor_;
    Seen& seen_;
    std::vector<State> states_;
    std::optional<Branch> other_;
    History<D> past_{game_.world, past_ticks};
    std::deque<ReferenceWorld<D>> records_;
    std::uint64_t recorded_ = 0;

public:
    int edited = 0, restored = 0, asked_past = 0;
};

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
        const Scene scene{first_seed + static_cast<std::uint64_t>(i), std::array{40, 12, 25, 60}[i % 4], lattice,
                          continuous};
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
