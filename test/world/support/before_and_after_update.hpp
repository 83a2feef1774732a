#pragma once

// Checks of queries on a world before the update that takes its items into the trees, and after it.

#include <abut/world/world.hpp>

#include <gtest/gtest.h>

namespace abut::test {

/// Runs the checks on the world, and once more after an update.
template <int D, class Check>
void before_and_after_update(World<D>& world, Check check) {
    {
        SCOPED_TRACE("before the update");
        check();
    }
    world.update();
    {
        SCOPED_TRACE("after the update");
        check();
    }
}

}  // namespace abut::test
