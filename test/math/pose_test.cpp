#include "../oracle/random.hpp"
#include <abut/math/affine.hpp>
#include <abut/math/motion.hpp>
#include <abut/math/pose.hpp>

#include <algorithm>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

constexpr double ulp = 1.2e-7;

template <class T>
class Poses : public testing::Test {};
template <int d>
struct Dimension {
    static constexpr int value = d;
};
using Both = testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Poses, Both);

template <int D>
Pose<D> some_pose(oracle::Random& random, double reach) {
    return {Vec<D>(random.in_cube<D>() * reach), random.rotation<D>()};
}

template <int D>
double gap(const Vec<D>& a, const Vec<D>& b) {
    return length(DVec<D>(a) - DVec<D>(b));
}

double gap(const Turn& a, const Turn& b) {
    return gap<2>({a.cos, a.sin}, {b.cos, b.sin});
}
/// A quaternion and its negative are equal rotations.
double gap(const glm::quat& a, const glm::quat& b) {
    const auto squared = [&](double sign) {
        double sum = 0;
        for (int i = 0; i < 4; ++i) sum += std::pow(double{a[i]} - sign * double{b[i]}, 2);
        return sum;
    };
    return std::sqrt(std::min(squared(1), squared(-1)));
}

Turn scaled(const Turn& turn, float factor) {
    return {turn.cos * factor, turn.sin * factor};
}
glm::quat scaled(const glm::quat& q, float factor) {
    return {q.w * factor, q.x * factor, q.y * factor, q.z * factor};
}

void expect_turn(const Turn& turn, double cos, double sin, float radians) {
    // An ulp of the result, near zero too.
    EXPECT_NEAR(turn.cos, cos, std::abs(cos) * ulp) << radians;
    EXPECT_NEAR(turn.sin, sin, std::abs(sin) * ulp) << radians;
}

TEST(Turn, ByAnAngle) {
    EXPECT_EQ(Turn::by(0), Turn());
    oracle::Random random(1);
    for (int repeat = 0; repeat < 20000; ++repeat) {
        const float radians = static_cast<float>(random.uniform(-1, 1) * random.power_of_two(-20, 17));
        expect_turn(Turn::by(radians), std::cos(double{radians}), std::sin(double{radians}), radians);
    }
    for (int quarters = -100000; quarters <= 100000; ++quarters) {
        const float radians = static_cast<float>(quarters * 1.5707963267948966);
        expect_turn(Turn::by(radians), std::cos(double{radians}), std::sin(double{radians}), radians);
    }
}

TEST(Turn, AboutAnAxis) {
    oracle::Random random(2);
    for (int repeat = 0; repeat < 5000; ++repeat) {
        const float radians = random.uniform_float(-20, 20);
        const Vec3 about(random.direction<3>());
        const glm::quat q = turn_about(about, radians);
        const DVec<3> expected = normalized(DVec<3>(about)) * std::sin(0.5 * double{radians});
        EXPECT_NEAR(q.w, std::cos(0.5 * double{radians}), ulp) << radians;
        EXPECT_LE(gap<3>({q.x, q.y, q.z}, Vec3(expected)), 2 * ulp) << radians;
        EXPECT_LE(gap(turn_about(about * 3.0f, radians), q), 2 * ulp) << "the length of the axis doesn't matter";
    }
}

TEST(Turn, ByHand) {
    const float quarter = 1.57079633f;
    EXPECT_LE(gap(rotate(Turn::by(quarter), Vec2(1, 0)), Vec2(0, 1)), ulp);
    EXPECT_LE(gap(rotate(Turn::by(quarter), Vec2(0, 1)), Vec2(-1, 0)), ulp);
    EXPECT_LE(gap(rotate(turn_about({0, 0, 1}, quarter), Vec3(1, 0, 0)), Vec3(0, 1, 0)), ulp);
    EXPECT_LE(gap(rotate(turn_about({1, 0, 0}, quarter), Vec3(0, 1, 0)), Vec3(0, 0, 1)), ulp);
    EXPECT_LE(gap(rotate(turn_about({0, 1, 0}, quarter), Vec3(0, 0, 1)), Vec3(1, 0, 0)), ulp);
    EXPECT_LE(gap(Pose3{{1, 2, 3}, turn_about({0, 0, 1}, quarter)} * Vec3(1, 0, 5), Vec3(1, 3, 8)), 8 * ulp);
    // The inner pose rotates first, then the outer one moves.
    const Pose2 rotating{{0, 0}, Turn::by(quarter)}, moving{{5, 0}, {}};
    EXPECT_LE(gap(moving * rotating * Vec2(1, 0), Vec2(5, 1)), 8 * ulp);
    EXPECT_LE(gap(rotating * moving * Vec2(1, 0), Vec2(0, 6)), 8 * ulp);
}

TYPED_TEST(Poses, ObeyTheLawsOfMaps) {
    constexpr int D = TypeParam::value;
    oracle::Random random(3);
    for (int repeat = 0; repeat < 2000; ++repeat) {
        SCOPED_TRACE(testing::Message() << "seed 3, repeat " << repeat);
        const double reach = random.power_of_two(-10, 14), little = 16 * ulp * reach;
        const auto a = some_pose<D>(random, reach), b = some_pose<D>(random, reach), c = some_pose<D>(random, reach);
        const Vec<D> p(random.in_cube<D>() * reach), q(random.in_cube<D>() * reach);
        EXPECT_LE(gap((a * b) * p, a * (b * p)), little);
        const Pose<D> left = (a * b) * c, right = a * (b * c);
        EXPECT_LE(gap(left.position, right.position), little);
        EXPECT_LE(gap(left.rotation, right.rotation), 4 * ulp);
        EXPECT_LE(gap(inverse(a) * (a * p), p), little);
        EXPECT_LE(gap(a * (inverse(a) * p), p), little);
        const Pose<D> none = a * inverse(a);
        EXPECT_LE(gap(none.position, Vec<D>(0)), little);
        EXPECT_LE(gap(none.rotation, no_rotation<D>), 4 * ulp);
        EXPECT_EQ(Pose<D>() * p, p);
        EXPECT_EQ(a * Vec<D>(0), a.position);
        EXPECT_NEAR(gap(a * p, a * q), gap(p, q), little) << "distances stay";
        EXPECT_LE(gap(rotate(a.rotation, p), (a * p) - a.position), little);
    }
}

TYPED_TEST(Poses, TurnAndNeverScale) {
    constexpr int D = TypeParam::value;
    oracle::Random random(4);
    for (int repeat = 0; repeat < 500; ++repeat) {
        const auto a = some_pose<D>(random, 10);
        const Vec<D> p(random.in_cube<D>());
        for (const float factor : {0.9f, 1.01f, 100.0f, 1e-18f}) {
            const Pose<D> drifted{a.position, scaled(a.rotation, factor)};
            EXPECT_LE(gap(drifted * p, a * p), 32 * ulp);
            EXPECT_LE(gap(inverse(drifted) * p, inverse(a) * p), 32 * ulp);
            EXPECT_LE(gap((drifted * drifted).rotation, (a * a).rotation), 4 * ulp);
        }
        EXPECT_EQ((Pose<D>{a.position, scaled(a.rotation, 0)} * p), (Pose<D>{a.position} * p)) << "no rotation at all";
    }
}

TYPED_TEST(Poses, AsAffineMaps) {
    constexpr int D = TypeParam::value;
    oracle::Random random(5);
    for (int repeat = 0; repeat < 500; ++repeat) {
        const auto a = some_pose<D>(random, 10), b = some_pose<D>(random, 10);
        const DVec<D> p = random.in_cube<D>();
        EXPECT_EQ(to_float(affine(a).point(DVec<D>(Vec<D>(p)))), a * Vec<D>(p));
        EXPECT_LE(length((affine(a) * affine(b)).point(p) - affine(a).point(affine(b).point(p))), 1e-13);
        // A rotation's inverse is its transpose.
        EXPECT_LE(length(affine(a).transposed(affine(a).vector(p)) - p), 1e-14);
        EXPECT_NEAR(length(affine(a).vector(p)), length(p), 1e-14);
        const Vec<D> scale(random.in_cube<D>());
        const DVec<D> q = scaling<D>(scale).point(p);
        for (int i = 0; i < D; ++i) EXPECT_EQ(q[i], double{scale[i]} * p[i]);
    }
    EXPECT_EQ(Affine<D>().point(DVec<D>(3)), DVec<D>(3));
}

template <class T, class... Arguments>
concept Makes = requires(Arguments... arguments) {
    T{arguments...};
};

/// Pose2{position, 0.785f} once took the angle for a cosine, and -0.785f for half a turn.
TEST(Turn, IsNoLoneNumber) {
    static_assert(!Makes<Turn, float> && !Makes<Turn, double> && !Makes<Turn, int> && Makes<Turn, float, float>);
    static_assert(!std::is_convertible_v<float, Turn> && !std::is_constructible_v<Turn, float>);
    static_assert(!Makes<Pose2, Vec2, float> && !Makes<Pose2, Vec2, int> && !Makes<Pose2, Vec2, float, float>);
    static_assert(Makes<Pose2, Vec2, Turn> && Makes<Pose2, Vec2> && Makes<Pose2>);
    static_assert(!Makes<Pose3, Vec3, float> && !Makes<Pose3, Vec3, float, float, float, float>);
    static_assert(!Makes<Motion2, Vec2, float> && !Makes<Motion2, Vec2, float, Vec2> && !Makes<Motion3, Vec3, float>);
    static_assert(Makes<Motion2, Pose2, Vec2, float> && Makes<Motion3, Pose3, Vec3, Vec3>);
    static_assert(std::is_trivially_copyable_v<Turn> && std::is_standard_layout_v<Pose2> && sizeof(Pose2) == 16);
    constexpr Pose2 turned{{1, 2}, {0, 1}}, named{.position = {1, 2}, .rotation = {0, 1}}, moved{.position = {3, 4}};
    static_assert(no_rotation<2>.cos == 1 && moved.rotation.cos == 1);
    EXPECT_EQ(turned, named);
    EXPECT_EQ(moved.rotation, Turn{});
    const auto [position, rotation] = turned;
    const auto [cosine, sine] = rotation;
    EXPECT_EQ(position, Vec2(1, 2));
    EXPECT_EQ(cosine, 0);
    EXPECT_EQ(sine, 1);
}

}  // namespace
}  // namespace abut::test
