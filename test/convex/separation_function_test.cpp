// The separation function of two moving shapes: where it reports a gap, finely sampled gaps confirm it.

#include "../oracle/check.hpp"
#include "../oracle/pair.hpp"
#include <abut/convex/toi/separation_function.hpp>

namespace abut {

using namespace detail;

namespace {

template <int D>
AngularVelocity<D> random_spin(oracle::Random& random, double most) {
    if constexpr (D == 2)
        return random.uniform(-most, most);
    else
        return random.direction<3>() * random.uniform(0, most);
}

template <int D>
struct Case {
    oracle::SamplePair<D> pair;
    RotatingSet<D> a, b;
    DVec<D> normal;
    AngularVelocity<D> angular_velocity;

    explicit Case(oracle::Random& random)
        : pair{oracle::SampleGenerator<D>(oracle::Random(random.bits()), random.in_cube<D>(), 1).make(kind(random)),
               oracle::SampleGenerator<D>(oracle::Random(random.bits()), random.in_cube<D>(), 1).make(kind(random))},
          a(std::get<Convex<D>>(pair.a.view), path(random, 0), 0),
          b(std::get<Convex<D>>(pair.b.view), path(random, 6), 0),
          normal(random.direction<D>()),
          angular_velocity(random_spin<D>(random, 4)) {
        // Half of the axes rotate with one of the two.
        if (random.chance(0.25)) angular_velocity = a.path().angular_velocity;
        if (random.chance(0.25)) angular_velocity = b.path().angular_velocity;
        if (random.chance(0.7)) {
            const DVec<D> offset = b.path().pivot(0) - a.path().pivot(0);
            normal = normalized(offset + random.in_cube<D>() * length(offset));
        }
    }

private:
    static oracle::Kind kind(oracle::Random& random) {
        return static_cast<oracle::Kind>(random.below(static_cast<std::uint32_t>(oracle::kind_count)));
    }
    static RigidPath<D> path(oracle::Random& random, double away) {
        RigidPath<D> result = rigid_path(Motion<D>{{to_float(random.in_cube<D>() * away), random.rotation<D>()}});
        result.move = random.in_cube<D>() * 2.0;
        result.angular_velocity = random_spin<D>(random, random.chance(0.2) ? 0 : 7);
        return result;
    }
};

template <int D>
void expect_bend_holds(std::uint64_t seed, double& sharpest) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    oracle::Random random(seed);
    Case<D> c(random);
    SeparationFunction<D> gap(c.a, c.b, c.normal, c.angular_velocity, 0);
    // A case with one corner each.
    const auto& core_a = c.a.here();
    const auto& core_b = c.b.here();
    c.a.go_to(0);
    c.b.go_to(0);
    const DVec<D> direction_a = random.direction<D>(), direction_b = random.direction<D>();
    const DVec<D> on_a = core_support(core_a, direction_a).position - c.a.path().start.offset,
                  on_b = core_support(core_b, direction_b).position - c.b.path().start.offset;
    const RotationAxis<D> turn_a(c.a.path().angular_velocity), turn_b(c.b.path().angular_velocity),
        turn_n(c.angular_velocity);
    const auto between = [&](double time) {
        const DVec<D> b = c.b.path().pivot(time) + turn_b.of(on_b).at(sin_cos(turn_b.rate * time));
        const DVec<D> a = c.a.path().pivot(time) + turn_a.of(on_a).at(sin_cos(turn_a.rate * time));
        return dot(turn_n.of(c.normal).at(sin_cos(turn_n.rate * time)), b - a);
    };
    const double bend = gap.acceleration_bound(), h = 1e-3;
    for (int i = 1; i < 20; ++i) {
        const double time = i / 20.0;
        const double measured = (between(time + h) - 2 * between(time) + between(time - h)) / (h * h);
        EXPECT_LE(std::abs(measured), bend * 1.0001 + 1e-5);
        if (bend > 0) sharpest = std::max(sharpest, std::abs(measured) / bend);
    }
}

TEST(SeparationFunction, AcceleratesWithinItsBound) {
    double sharpest = 0;
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
        expect_bend_holds<2>(seed, sharpest);
        expect_bend_holds<3>(seed, sharpest);
    }
    EXPECT_GT(sharpest, 0.9);
}

struct StepCounts {
    int whole = 0, closed = 0, cut = 0;
};

template <int D>
void expect_open(std::uint64_t seed, StepCounts& tally) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    oracle::Random random(seed);
    Case<D> c(random);
    SeparationFunction<D> gap(c.a, c.b, c.normal, c.angular_velocity, 0);
    const double level = gap.at(0).gap - random.uniform(0.01, 2), tolerance = 1e-3;
    const SeparatedUntil open = separated_until(gap, 0, 1, gap.at(0), level, tolerance);
    ASSERT_GE(open.time, 0);
    ASSERT_LE(open.time, 1);
    EXPECT_EQ(open.gap, gap.at(open.time).gap);
    for (int i = 0; i <= 500; ++i) EXPECT_GE(gap.at(open.time * i / 500).gap, level - 1e-12);
    (open.time == 1 ? tally.whole : open.gap <= level + tolerance ? tally.closed : tally.cut) += 1;
}

TEST(SeparationFunction, IsOpenUntilTheReportedTime) {
    StepCounts tally;
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
        expect_open<2>(seed, tally);
        expect_open<3>(seed, tally);
    }
    EXPECT_GT(tally.whole, 400);
    EXPECT_GT(tally.closed, 2000);
    EXPECT_EQ(tally.cut, 0);  // the bound on steps is far off
}

TEST(SeparationFunction, ThatIsClosedIsNotFollowed) {
    oracle::Random random(1);
    Case<3> c(random);
    SeparationFunction<3> gap(c.a, c.b, c.normal, c.angular_velocity, 0);
    EXPECT_EQ(separated_until(gap, 0.25, 1, gap.at(0.25), gap.at(0.25).gap + 1, 0.1).time, 0.25);
}

/// The reported rate of the gap is that of the axis and the corners.
TEST(SeparationFunction, ReturnsItsRate) {
    int smooth = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        oracle::Random random(seed);
        Case<3> c(random);
        SeparationFunction<3> gap(c.a, c.b, c.normal, c.angular_velocity, 0);
        const double time = random.uniform(0.1, 0.9), h = 1e-5;
        const double before = gap.at(time - h).gap, after = gap.at(time + h).gap, rate = gap.at(time).rate;
        smooth += std::abs((after - before) / (2 * h) - rate) < 1e-3 ? 1 : 0;
    }
    EXPECT_GT(smooth, 270);  // the rest changes corners there, or is a user's shape that answers in floats
}

/// Corners of a flat box in one place were an edge of no length, by whose length an axis was divided.
TEST(SeparationFunction, HasAnAxisBesideCornersInOnePlace) {
    const Box3 flat{{0, 0, 0}, {0.5f, 0, 0.5f}}, other{{0, 2, 0}, {0.5f, 0.5f, 0.5f}};
    RigidPath<3> path = rigid_path(Motion<3>{});
    path.angular_velocity = {0.3, 0.2, 0.1};
    const RotatingSet<3> a(convex(flat), path, 0), b(convex(other), path, 0);
    for (std::uint32_t first = 0; first < 8; ++first)
        for (std::uint32_t second = 0; second < 8; ++second) {
            ClosestCorners<3> corners;
            corners.count = 2;
            corners.a = {first, second};
            corners.b = {first, first};
            EXPECT_TRUE(is_finite<3>(axis_angular_velocity(a, b, DVec<3>(0, 1, 0), corners))) << first << ' ' << second;
        }
}

}  // namespace
}  // namespace abut
