#include "../oracle/random.hpp"
#include <abut/math/detail/round_outwards.hpp>
#include <abut/math/simd/lanes-inl.h>

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace abut::test {
using namespace detail;
namespace {

/// Compares the bits with those of the definition.
void expect_rounded(double x) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const auto nearest = static_cast<float>(x);
    const float below = static_cast<double>(nearest) > x ? std::nextafter(nearest, -infinity) : nearest;
    const float above = static_cast<double>(nearest) < x ? std::nextafter(nearest, infinity) : nearest;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(float_at_most(x)), std::bit_cast<std::uint32_t>(below)) << x;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(float_at_least(x)), std::bit_cast<std::uint32_t>(above)) << x;
    const lanes::Floats4 outer = lanes::floats_at_least({x, 1.0}, {-1.0, x}),
                         inner = lanes::floats_at_least({1.0, x}, {x, -1.0});
    for (const float lane : {outer[0], inner[1], inner[2], outer[3]})
        EXPECT_EQ(std::bit_cast<std::uint32_t>(lane), std::bit_cast<std::uint32_t>(above)) << x;
    EXPECT_EQ(outer[1], 1);
    EXPECT_EQ(outer[2], -1);
}

TEST(RoundOutwards, IsTheAdjacentFloat) {
    constexpr double largest = std::numeric_limits<float>::max(), smallest = std::numeric_limits<float>::denorm_min();
    for (const double x : {0.0, 1.0, 0.1, 1e-300, 0.4 * smallest, 0.6 * smallest, smallest, 1.5 * smallest, largest,
                           1.00000001 * largest, 1e300, std::numeric_limits<double>::infinity()}) {
        expect_rounded(x);
        expect_rounded(-x);
    }
    EXPECT_TRUE(std::isnan(float_at_most(std::numeric_limits<double>::quiet_NaN())));
    EXPECT_TRUE(std::isnan(float_at_least(std::numeric_limits<double>::quiet_NaN())));
    oracle::Random random(1);
    for (int i = 0; i < 100000; ++i)
        expect_rounded(std::ldexp(random.uniform(-1, 1), static_cast<int>(random.below(300)) - 160));
}

}  // namespace
}  // namespace abut::test
