#pragma once

// The parameter of tests that run in the plane and in space.

#include <gtest/gtest.h>

namespace abut::test {

template <int d>
struct Dimension {
    static constexpr int value = d;
};
using Both = testing::Types<Dimension<2>, Dimension<3>>;

}  // namespace abut::test
