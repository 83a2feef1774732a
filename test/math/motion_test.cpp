// Motions, and the sines of their rotations.

#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include <abut/math/detail/rigid_path.hpp>
#include <abut/math/detail/set_affine.hpp>
#include <abut/math/motion.hpp>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

constexpr double pi = 3.14159265358979323846;

TEST(SinCos, AreThoseOfTheCLibraryButForTheLastDigits) {
    oracle::Random random(1);
    for (int i = 0; i < 10000; ++i) {
        const double angle = random.uniform(-1, 1) * random.power_of_two(-20, 10);
        const SinCos s = sin_cos(angle);
        const double tolerance = 4e-16 * (1 + std::abs(angle));
        EXPECT_NEAR(s.sin, std::sin(angle), tolerance) << angle;
        EXPECT_NEAR(s.cos, std::cos(angle), tolerance) << angle;
    }
}

TEST(AngleOf, IsTheAngleOfTheVector) {
    oracle::Random random(2);
    for (int i = 0; i < 10000; ++i) {
        const DVec<2> v = random.direction<2>() * random.power_of_two(-30, 30);
        EXPECT_NEAR(angle_of(v.x, v.y), std::atan2(v.y, v.x), 1e-15 * 4) << v.x << ' ' << v.y;
    }
    EXPECT_EQ(angle_of(1, 0), 0);
    EXPECT_NEAR(angle_of(0, 1), 0.5 * pi, 1e-15);
    EXPECT_NEAR(angle_of(0, -1), -0.5 * pi, 1e-15);
    EXPECT_NEAR(angle_of(-1, 0), pi, 1e-15);
    EXPECT_NEAR(angle_of(-1, -0.0), pi, 1e-15);
}

TEST(Motion, BetweenTwoPosesRotatesTheShortArc) {
    const Motion2 back = Motion2::between({{1, 2}, Turn::by(3)}, {{4, 6}, Turn::by(-3)});
    EXPECT_EQ(back.move, Vec2(3, 4));
    EXPECT_NEAR(back.turn, 2 * pi - 6, 1e-6);

    const Vec3 axis(0.6f, 0, 0.8f);
    const Motion3 motion = Motion3::between({{0, 0, 0}, turn_about(axis, 1)}, {{1, 0, 0}, turn_about(axis, 3)});
    EXPECT_TRUE(near(motion.turn, 2.0f * axis));
    // An equal rotation, by the quaternion of opposite sign.
    const Motion3 same = Motion3::between({{0, 0, 0}, turn_about(axis, 1)}, {{1, 0, 0}, -turn_about(axis, 3)});
    EXPECT_TRUE(near(same.turn, 2.0f * axis));
    EXPECT_EQ(Motion3::between({}, {}).turn, Vec3(0));
}

template <int D>
void expect_exact_ends(std::uint64_t seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    oracle::Random random(seed);
    const Pose<D> from{to_float(random.in_cube<D>()), random.rotation<D>()};
    const Pose<D> to{to_float(random.in_cube<D>()), random.rotation<D>()};
    const Motion<D> motion = Motion<D>::between(from, to);
    const Vec<D> point = to_float(random.in_cube<D>());
    EXPECT_TRUE(near(pose_at(motion, 0) * point, from * point, 1e-6));
    EXPECT_TRUE(near(pose_at(motion, 1) * point, to * point, 1e-6));
    const RigidPath<D> path = rigid_path(from, to);
    EXPECT_LE(angular_speed(path.angular_velocity), pi * (1 + 1e-15));
    const Affine<D> last = affine(to);
    EXPECT_LE(length(place_at(path, 1).point(DVec<D>(point)) - last.point(DVec<D>(point))), 1e-14);
    // The rotation is uniform: a third and another third make two thirds.
    const Pose<D> third = pose_at(motion, 1.0f / 3);
    Motion<D> rest = motion;
    rest.from = third;
    EXPECT_TRUE(near(pose_at(rest, 1.0f / 3) * point, pose_at(motion, 2.0f / 3) * point, 2e-6));
    // The derivative equals the velocity.
    const double time = random.unit(), small = 1e-6;
    const auto place = [&](double t) { return place_at(path, t).point(DVec<D>(point)); };
    const DVec<D> speed = (place(time + small) - place(time - small)) / (2 * small);
    EXPECT_LE(length(path.velocity(time, place(time)) - speed), 1e-8);
}

TEST(Motion, EndsWhereItShould) {
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
        expect_exact_ends<2>(seed);
        expect_exact_ends<3>(seed);
    }
}

TEST(Motion, CountsWholeTurns) {
    const Motion2 around{{}, {}, static_cast<float>(2 * pi)};
    EXPECT_TRUE(near(pose_at(around, 0.25f) * Vec2(1, 0), Vec2(0, 1)));
    EXPECT_TRUE(near(pose_at(around, 0.5f) * Vec2(1, 0), Vec2(-1, 0)));
    EXPECT_TRUE(near(pose_at(around, 1) * Vec2(1, 0), Vec2(1, 0)));
    const Motion3 twice{{}, {}, {0, 0, static_cast<float>(4 * pi)}};
    EXPECT_TRUE(near(pose_at(twice, 0.125f) * Vec3(1, 0, 5), Vec3(0, 1, 5), 2e-6));
}

}  // namespace
}  // namespace abut
