#pragma once

// Operations of all kinds on a world and on the reference world: changes, updates, questions, snapshots, copies and the
// past.

#include "checks.hpp"
#include <abut/world/history.hpp>

#include <deque>

namespace abut::test {

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

}  // namespace abut::test
