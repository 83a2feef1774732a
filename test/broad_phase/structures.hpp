#pragma once

// The list of all broad phases, for typed tests.

#include "any_broad_phase.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/chosen_broad_phase.hpp>
#include <abut/broad_phase/grid.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/broad_phase/sweep_and_prune.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using AllBroadPhases = testing::Types<   //
    BruteForce<2>, BruteForce<3>,        //
    Grid<2>, Grid<3>,                    //
    LayeredGrid<2>, LayeredGrid<3>,      //
    SweepAndPrune<2>, SweepAndPrune<3>,  //
    Bvh<2>, Bvh<3>,                      //
    Bsp<2>, Bsp<3>,                      //
    ChosenBroadPhase<2>, ChosenBroadPhase<3>>;

/// The base of their suites. A test passes `empty` to a function of the dimension, which is compiled once for all
/// types.
template <class T>
class EachBroadPhase : public testing::Test {
protected:
    const AnyBroadPhase<dimension_of<T>> empty = AnyBroadPhase<dimension_of<T>>::template of<T>();
};

}  // namespace abut::test
