#pragma once

// All broad phases, for what is tested of each of them.

#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/bvh.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using AllBroadPhases = testing::Types<  //
    BruteForce<2>, BruteForce<3>,       //
    Bvh<2>, Bvh<3>,                     //
    Bsp<2>, Bsp<3>>;

}  // namespace abut::test
