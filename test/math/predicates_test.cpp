// The predicates against rational numbers, on all kinds of points: random, nearly degenerate, exactly degenerate, and
// of any exponents.
#include "../oracle/random.hpp"
#include "../oracle/rational.hpp"
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using oracle::Random;
using oracle::Rational;

template <int D>
using RationalVec = std::array<oracle::Rational, D>;
template <int D>
using Points = std::array<Vec<D>, D + 1>;

template <int D>
RationalVec<D> difference(const Vec<D>& a, const Vec<D>& b) {
    RationalVec<D> result;
    for (int i = 0; i < D; ++i) result[static_cast<std::size_t>(i)] = Rational(a[i]) - Rational(b[i]);
    return result;
}

RationalVec<3> cross(const RationalVec<3>& p, const RationalVec<3>& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

int exact(const Points<2>& points) {
    const RationalVec<2> p = difference<2>(points[1], points[0]), q = difference<2>(points[2], points[0]);
    return Rational(p[0] * q[1] - p[1] * q[0]).sign();
}
int exact(const Points<3>& points) {
    const RationalVec<3> normal = cross(difference<3>(points[1], points[0]), difference<3>(points[2], points[0]));
    const RationalVec<3> r = difference<3>(points[3], points[0]);
    return Rational(normal[0] * r[0] + normal[1] * r[1] + normal[2] * r[2]).sign();
}
bool exactly_on_line(const Vec3& a, const Vec3& b, const Vec3& p) {
    const RationalVec<3> normal = cross(difference<3>(b, a), difference<3>(p, a));
    return normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
}

int in_double(const Points<2>& points) {
    const double turn =
        abut::detail::cross(DVec<2>(points[1]) - DVec<2>(points[0]), DVec<2>(points[2]) - DVec<2>(points[0]));
    return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}
int in_double(const Points<3>& points) {
    const DVec<3> a(points[0]);
    const double volume =
        dot(abut::detail::cross(DVec<3>(points[1]) - a, DVec<3>(points[2]) - a), DVec<3>(points[3]) - a);
    return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

int orientation_of(const Points<2>& p) {
    return orientation(p[0], p[1], p[2]);
}
int orientation_of(const Points<3>& p) {
    return orientation(p[0], p[1], p[2], p[3]);
}

float moved_by_ulps(float value, int ulps) {
    const float towards = ulps < 0 ? -std::numeric_limits<float>::infinity() : std::numeric_limits<float>::infinity();
    for (int i = 0; i < std::abs(ulps); ++i) value = std::nextafter(value, towards);
    return value;
}

float any_finite_float(Random& random) {
    for (;;) {
        const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
        if (std::isfinite(value)) return value;
    }
}

// An extreme float; a sum of these may need every bit between 2^-149 and 2^128.
float extreme_float(Random& random) {
    constexpr float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    constexpr std::array<float, 8> values{0, least, 3 * least, 1e-38f, 1, 1 + 0x1p-23f, 3e38f, most};
    const float value = values[random.below(values.size())];
    return random.chance(0.5) ? value : -value;
}

template <int D, class Coordinate>
Points<D> points_of(Coordinate coordinate) {
    Points<D> result;
    for (Vec<D>& point : result)
        for (int i = 0; i < D; ++i) point[i] = coordinate();
    return result;
}

/// The last point is an affine combination of the others, and so degenerate before it is rounded.
template <int D>
Points<D> coherent(Random& random, double away, int ulps) {
    const DVec<D> offset = random.direction<D>() * away;
    Points<D> result;
    for (Vec<D>& point : result) point = to_float(random.in_cube<D>() + offset);
    DVec<D> last(result[0]);
    for (std::size_t i = 1; i < D; ++i) last += random.uniform(-1, 2) * (DVec<D>(result[i]) - DVec<D>(result[0]));
    result[D] = to_float(last);
    for (int i = 0; i < D; ++i)
        result[D][i] = moved_by_ulps(result[D][i],
                                     static_cast<int>(random.below(2 * static_cast<std::uint32_t>(ulps) + 1)) - ulps);
    return result;
}

/// Near a line or plane through the origin, and much closer to the origin than all others: the differences need more
/// bits than a double has.
template <int D>
Points<D> close_to_the_origin(Random& random) {
    Points<D> result;
    for (Vec<D>& point : result) point = to_float(random.in_cube<D>());
    result[D - 1] = -result[0];
    DVec<D> last(0.0);
    for (std::size_t i = 0; i + 1 < D; ++i) last += random.uniform(-1, 1) * DVec<D>(result[i]);
    result[D] = to_float(last * random.power_of_two(-60, -20));
    return result;
}

/// Exactly collinear or coplanar points, scaled by any power of two.
template <int D>
Points<D> flat(Random& random) {
    const auto small = [&] { return static_cast<float>(random.below(2001)) - 1000; };
    std::array<Vec<D>, D> spanning;
    for (Vec<D>& v : spanning)
        for (int i = 0; i < D; ++i) v[i] = small();
    const auto scale = static_cast<float>(std::ldexp(1.0, static_cast<int>(random.below(230)) - 140));
    Points<D> result;
    for (Vec<D>& point : result) {
        point = spanning[0];
        for (std::size_t i = 1; i < D; ++i) point += small() * spanning[i];
        point *= scale;
    }
    return result;
}

template <int D>
Points<D> of_kind(int kind, Random& random) {
    switch (kind) {
        case 0:
            return points_of<D>([&] { return random.uniform_float(-1, 1); });
        case 1:
            return points_of<D>([&] { return static_cast<float>(random.below(4)); });
        case 2:
            return points_of<D>([&] { return any_finite_float(random); });
        case 3:
            return points_of<D>([&] { return extreme_float(random); });
        case 4:
            return coherent<D>(random, 0, 1);
        case 5:
            return coherent<D>(random, 1e4, 1);
        case 6:
            return coherent<D>(random, 10, 4);
        case 7:
            return close_to_the_origin<D>(random);
        default:
            return flat<D>(random);
    }
}

template <int D>
void expect_exact() {
    std::map<int, int> signs;
    int wrong_in_double = 0;
    for (int kind = 0; kind < 9; ++kind)
        for (std::uint64_t round = 0; round < 3000; ++round) {
            const std::uint64_t seed = 10000 * static_cast<std::uint64_t>(kind) + round;
            Random random(seed);
            const Points<D> points = of_kind<D>(kind, random);
            const int expected = exact(points);
            ASSERT_EQ(orientation_of(points), expected) << "kind " << kind << ", seed " << seed;
            ++signs[expected];
            wrong_in_double += in_double(points) != expected ? 1 : 0;

            // Swapping two of the points changes the sign.
            for (std::size_t i = 0; i < points.size(); ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    Points<D> swapped = points;
                    std::swap(swapped[i], swapped[j]);
                    ASSERT_EQ(orientation_of(swapped), -expected) << "kind " << kind << ", seed " << seed;
                }
            if (kind == 8) {
                ASSERT_EQ(expected, 0) << "meant to be flat";
            }
        }
    for (const int sign : {-1, 0, 1}) EXPECT_GT(signs[sign], 3000) << sign;
    EXPECT_GT(wrong_in_double, 200);
}

TEST(Predicates, KnowTheTurnExactly) {
    expect_exact<2>();
}

TEST(Predicates, KnowTheSideExactly) {
    expect_exact<3>();
}

TEST(Predicates, TurnCounterClockwiseIsPositive) {
    EXPECT_EQ(orientation(Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)), 1);
    EXPECT_EQ(orientation(Vec2(0, 0), Vec2(0, 1), Vec2(1, 0)), -1);
    EXPECT_EQ(orientation(Vec2(0, 0), Vec2(1, 2), Vec2(3, 6)), 0);
    EXPECT_EQ(orientation(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(5, -7, 0x1p-149f)), 1);
    EXPECT_EQ(orientation(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(5, -7, -0x1p-149f)), -1);
    EXPECT_EQ(orientation(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(5, -7, 0)), 0);
}

// The smallest offset from the largest line or plane in floats.
TEST(Predicates, SeeADenormalFromTheGreatestDistance) {
    constexpr float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(orientation(Vec2(-most, -most), Vec2(most, most), Vec2(0, least)), 1);
    EXPECT_EQ(orientation(Vec2(-most, -most), Vec2(most, most), Vec2(least, 0)), -1);
    EXPECT_TRUE(on_line(Vec2(-most, -most), Vec2(most, most), Vec2(least, least)));
    EXPECT_FALSE(on_line(Vec3(-most), Vec3(most), Vec3(least, least, 0)));
    EXPECT_TRUE(on_line(Vec3(-most), Vec3(most), Vec3(least)));
    EXPECT_EQ(orientation(Vec3(-most), Vec3(most), Vec3(most, -most, 0), Vec3(0, 0, least)),
              -orientation(Vec3(-most), Vec3(most), Vec3(most, -most, 0), Vec3(0, 0, -least)));
    EXPECT_FALSE(in_plane(Vec3(-most), Vec3(most), Vec3(most, -most, 0), Vec3(0, 0, least)));
    EXPECT_TRUE(in_plane(Vec3(-most), Vec3(most), Vec3(most, -most, 0), Vec3(least, -least, 0)));
}

TEST(Predicates, KnowWhatIsOnALine) {
    std::map<bool, int> answers;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        Random random(seed);
        const auto small = [&] { return static_cast<float>(random.below(200)) - 100; };
        const Vec3 a{small(), small(), small()}, along{small(), small(), small()};
        const float scale = static_cast<float>(std::ldexp(1.0, static_cast<int>(random.below(200)) - 100));
        const Vec3 b = (a + along) * scale;
        Vec3 p = (a + small() * along) * scale;
        const int axis = static_cast<int>(random.below(3));
        p[axis] = moved_by_ulps(p[axis], static_cast<int>(random.below(2)));
        const bool expected = exactly_on_line(a * scale, b, p);
        ASSERT_EQ(on_line(a * scale, b, p), expected) << "seed " << seed;
        ASSERT_EQ(on_line(p, b, a * scale), expected) << "seed " << seed;
        ++answers[expected];

        // A point of a line is in every plane through it.
        if (expected) {
            ASSERT_TRUE(in_plane(a * scale, b, to_float(random.in_cube<3>()), p)) << "seed " << seed;
        }
        const Vec2 shadow_a(a.x * scale, a.y * scale), shadow_b(b), shadow_p(p);
        ASSERT_EQ(on_line(shadow_a, shadow_b, shadow_p), orientation(shadow_a, shadow_b, shadow_p) == 0);
    }
    EXPECT_GT(answers[true], 400);
    EXPECT_GT(answers[false], 400);
}

TEST(Predicates, TakePointsThatSpanNoLineOrPlane) {
    const Vec3 a{1, 2, 3}, b{4, 5, 7}, p{-8, 9, 0.1f};
    EXPECT_TRUE(on_line(Vec2(1, 2), Vec2(1, 2), Vec2(5, 7)));
    EXPECT_TRUE(on_line(a, a, p));
    EXPECT_TRUE(on_line(a, b, a));
    EXPECT_TRUE(in_plane(a, b, b, p));
    EXPECT_TRUE(in_plane(a, b, 2.0f * b - a, p));
}

TEST(Predicates, KnowTheSignOfASumWhereDoublesCancel) {
    EXPECT_EQ(sign_of_sum(1e300, 1, -1e300), 1);
    EXPECT_EQ(sign_of_sum(1e300, -1, -1e300), -1);
    EXPECT_EQ(sign_of_sum(1, 0x1p-60, -1), 1);
    EXPECT_EQ(sign_of_sum(0x1p-1074, -1, 1), 1);
    EXPECT_EQ(sign_of_sum(0x1p-1074, -0x1p-1074, 0), 0);
    EXPECT_EQ(sign_of_sum(0, 0, 0), 0);
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        const double a = random.uniform(-1, 1) * random.power_of_two(-60, 60), b = random.uniform(-1, 1);
        const double c = -(a + b) + static_cast<double>(random.below(3)) * 0x1p-80;
        const Rational sum = Rational(a) + Rational(b) + Rational(c);
        ASSERT_EQ(sign_of_sum(a, b, c), sum.sign()) << "seed " << seed;
    }
}

}  // namespace
}  // namespace abut::test
