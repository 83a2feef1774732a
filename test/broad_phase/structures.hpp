#pragma once

// The list of all broad phases, for typed tests.

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

}  // namespace abut::test
