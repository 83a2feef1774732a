#include "../oracle/random.hpp"
#include "../oracle/rational.hpp"
#include <abut/math/detail/exact_orientation.hpp>

#include <array>

#include <gtest/gtest.h>

namespace abut::detail {
namespace {

using oracle::Rational;

int sign_of_rational(const Rational& value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

std::array<Rational, 3> difference(const DVec<3>& a, const DVec<3>& b) {
    return {Rational(a.x) - Rational(b.x), Rational(a.y) - Rational(b.y), Rational(a.z) - Rational(b.z)};
}

int rational_side(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, const DVec<3>& d) {
    const auto p = difference(b, a), q = difference(c, a), r = difference(d, a);
    return sign_of_rational((p[1] * q[2] - p[2] * q[1]) * r[0] + (p[2] * q[0] - p[0] * q[2]) * r[1] +
                            (p[0] * q[1] - p[1] * q[0]) * r[2]);
}

int rational_turn(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, int axis) {
    const auto p = difference(b, a), q = difference(c, a);
    const auto i = static_cast<std::size_t>((axis + 1) % 3), j = static_cast<std::size_t>((axis + 2) % 3);
    return sign_of_rational(p[i] * q[j] - p[j] * q[i]);
}

/// Points in general position, or nearly in a plane or on a line, up to the last bit; near the origin or far from it.
TEST(ExactOrientation, AgreesWithRationalNumbers) {
    constexpr std::uint64_t seed = 20266;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    std::array<int, 3> sides{}, turns{};
    for (int i = 0; i < 20'000; ++i) {
        const double scale = random.power_of_two(-20, 20);
        const DVec<3> origin = random.chance(0.5) ? DVec<3>(0.0) : random.in_cube<3>() * (1000 * scale);
        const auto point = [&] { return origin + random.in_cube<3>() * scale; };
        const DVec<3> a = point(), b = point();
        DVec<3> c = point(), d = point();
        if (random.chance(0.7)) d = a + (b - a) * random.uniform(-1, 1) + (c - a) * random.uniform(-1, 1);
        if (random.chance(0.5)) c = a + (b - a) * random.uniform(-1, 1);
        if (random.chance(0.3)) c = a + (b - a) * 2.0;
        const int side = exact_side(a, b, c, d), axis = static_cast<int>(random.below(3));
        ASSERT_EQ(side, rational_side(a, b, c, d));
        const int turn = exact_turn(a, b, c, axis);
        ASSERT_EQ(turn, rational_turn(a, b, c, axis));
        ++sides[static_cast<std::size_t>(side + 1)];
        ++turns[static_cast<std::size_t>(turn + 1)];
    }
    for (const std::array<int, 3>& counts : {sides, turns})
        for (const int count : counts) EXPECT_GT(count, 500);
}

}  // namespace
}  // namespace abut::detail
