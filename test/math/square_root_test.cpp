// A square root is correctly rounded, in code without optimisation too. The C library of MinGW-w64 rounds 222 of a
// million roots of doubles to the wrong neighbour, which gave 2D queries other bits on Windows.
#include "../oracle/random.hpp"
#include <abut/math/simd/square_root.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

/// Numbers whose root r has its last bit at 1. It is the nearest to the root of x if (r - 1/2)^2 < x < (r + 1/2)^2,
/// which says of whole numbers that -r < x - r^2 <= r. The difference is exact modulo 2^64.
template <class T>
void expect_correctly_rounded() {
    constexpr int digits = std::numeric_limits<T>::digits;
    oracle::Random random(9);
    for (int repeat = 0; repeat < 200000; ++repeat) {
        const std::uint64_t mantissa = random.bits() >> (64 - digits) | std::uint64_t{1} << (digits - 1);
        const int exponent = digits - 1 + static_cast<int>(random.below(2));
        const T x = std::ldexp(static_cast<T>(mantissa), exponent), r = square_root(x);
        const auto root = static_cast<std::int64_t>(r);
        const std::uint64_t square = static_cast<std::uint64_t>(root) * static_cast<std::uint64_t>(root);
        const auto excess = static_cast<std::int64_t>((mantissa << exponent) - square);
        ASSERT_TRUE(-root < excess && excess <= root) << "seed 9, repeat " << repeat << ", root of " << x;
    }
}

TEST(SquareRoot, IsCorrectlyRounded) {
    expect_correctly_rounded<float>();
    expect_correctly_rounded<double>();
}

TEST(SquareRoot, HasTheLimitsOfIeee754) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(square_root(0.0), 0);
    EXPECT_EQ(square_root(infinity), infinity);
    EXPECT_TRUE(std::isnan(square_root(-1.0)));
    EXPECT_EQ(square_root(std::numeric_limits<double>::denorm_min()), 0x1p-537);
}

}  // namespace
}  // namespace abut::test
