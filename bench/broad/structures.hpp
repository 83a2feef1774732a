#pragma once

// The library's broad phases that the rows compare: the one list to extend.

#include "../bench.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/chosen_broad_phase.hpp>
#include <abut/broad_phase/grid.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/broad_phase/sweep_and_prune.hpp>

#include <cstddef>
#include <string>
#include <type_traits>

namespace abut::bench {

/// "abut" in the table, the reference for ratios: the recommendation of docs/broad_phases.md.
template <int D>
using ForPairs = Grid<D>;
template <int D>
using ForQueries = Bvh<D>;

/// The maximum number of boxes for a side, so that a frame takes it less than a second, and the bench minutes.
struct Limits {
    std::size_t moving = 1'000'000;
    std::size_t skewed = moving;   ///< for skewed sizes and positions
    std::size_t scratch = moving;  ///< for a rebuild per frame
    std::size_t queries = moving;  ///< for queries of this many static boxes
};

template <class Phase>
struct Structure {
    using Type = Phase;
    const char* name;
    Limits limits = {};
};

/// Calls visit(structure) for each.
template <int D, class Visit>
void each_structure(Visit visit) {
    visit(Structure<BruteForce<D>>{"BruteForce", {.moving = 1000}});
    visit(Structure<Grid<D>>{"Grid"});
    visit(Structure<LayeredGrid<D>>{"LayeredGrid", {.moving = 100'000, .queries = 100'000}});
    visit(Structure<SweepAndPrune<D>>{"SweepAndPrune"});
    visit(Structure<Bvh<D>>{"Bvh"});
    visit(Structure<Bsp<D>>{"Bsp", {.moving = 10'000, .queries = 100'000}});
    visit(Structure<ChosenBroadPhase<D>>{"chosen"});
}

/// Informs the adaptive structure how its boxes are used; others ignore it.
template <class Phase>
void set_history(Phase& phase, const BroadPhaseHistory& history) {
    if constexpr (requires { phase.set_history(history); }) phase.set_history(history);
}

/// Calls visit(structure, who) for the one that is "abut", and then for the others.
template <int D, class Taken, class Visit>
void each_side(Visit visit) {
    visit(Structure<Taken>{""}, std::string("abut"));
    each_structure<D>([&](const auto& structure) {
        using Phase = typename std::remove_cvref_t<decltype(structure)>::Type;
        if constexpr (!std::is_same_v<Phase, Taken>) visit(structure, std::string("abut ") + structure.name);
    });
}

}  // namespace abut::bench
