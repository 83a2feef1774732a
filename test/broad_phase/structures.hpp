#pragma once

// All broad phases, for what is tested of each of them.

#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/layered_grid.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using AllBroadPhases = testing::Types<  //
    BruteForce<2>, BruteForce<3>,       //
    Bvh<2>, Bvh<3>,                     //
    LayeredGrid<2>, LayeredGrid<3>>;

}  // namespace abut::test
