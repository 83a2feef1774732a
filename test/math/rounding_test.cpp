// A conversion of a double to float rounds under any optimisation. GCC 12 at -O2 drops the conversion of two neighbours
// to float and back, unless it has the option -fno-tree-slp-vectorize.
#include "../oracle/random.hpp"
#include <abut/math/dvec.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

template <int D>
void expect_rounded() {
    oracle::Random random(8);
    for (int repeat = 0; repeat < 100; ++repeat) {
        const DVec<D> exact = random.in_cube<D>();
        const DVec<D> rounded(to_float(exact));
        for (int i = 0; i < D; ++i) {
            const volatile float one_by_one = static_cast<float>(exact[i]);
            EXPECT_EQ(rounded[i], double{one_by_one}) << "seed 8, repeat " << repeat;
        }
    }
}

TEST(Rounding, IsNotOptimisedAway) {
    expect_rounded<2>();
    expect_rounded<3>();
}

}  // namespace
}  // namespace abut::test
