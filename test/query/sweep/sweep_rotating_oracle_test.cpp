// Sweeps with rotation against the exact distance in fine steps of time: no hit is missed or late, and at the reported
// time of impact the shapes touch.

#include "../../oracle/check.hpp"
#include "../../oracle/pair.hpp"
#include <abut/math/detail/rigid_path.hpp>
#include <abut/query/sweep.hpp>

#include <numbers>

namespace abut {

using namespace detail;

namespace {

template <int D>
struct MovingPair {
    oracle::SamplePair<D> pair;
    Motion<D> motion_a, motion_b;
    RigidPath<D> path_a, path_b;
    double margin;
    double speed;  ///< an upper bound of the approach of any two points during the motion

    MovingPair(oracle::SamplePair<D> shapes, const Motion<D>& of_a, const Motion<D>& of_b)
        : pair(std::move(shapes)),
          motion_a(of_a),
          motion_b(of_b),
          path_a(rigid_path(of_a)),
          path_b(rigid_path(of_b)),
          margin(tolerance_for(pair.a.solid, pair.b.solid)),
          speed(length(path_b.move - path_a.move) + swing(pair.a, path_a) + swing(pair.b, path_b)) {}

    oracle::Truth<D> truth(double time) const {
        // The pose is relative to A, which avoids cancellation far from the origin.
        Affine<D> place_a = place_at(path_a, time), place_b = place_at(path_b, time);
        place_b.offset -= place_a.offset;
        place_a.offset = DVec<D>(0.0);
        return oracle::truth(mapped(pair.a.solid, place_a), mapped(pair.b.solid, place_b),
                             oracle::Arithmetic::floating_point);
    }
    double distance(double time) const { return truth(time).distance; }

    std::optional<Hit<D>> sweep() const { return abut::sweep(pair.a.view, motion_a, pair.b.view, motion_b); }

private:
    static double swing(const oracle::Sample<D>& shape, const RigidPath<D>& path) {
        double reach = 0;
        for (const DVec<D>& corner : corners_relative_to(shape.solid, DVec<D>(0.0)))
            reach = std::max(reach, length(corner));
        return angular_speed(path.angular_velocity) * reach;
    }
};

template <int D>
Angle<D> random_turn(oracle::Random& random, double max_distance) {
    const double angle = random.uniform(-max_distance, max_distance);
    if constexpr (D == 2)
        return static_cast<float>(angle);
    else
        return to_float(random.direction<3>() * angle);
}

/// Shapes of all kinds, up to rods twenty times as long as wide, that rotate about a point in or near them by up to a
/// full revolution. They pass each other so closely that about half of the pairs touch.
template <int D>
MovingPair<D> random_motion(oracle::Random& random) {
    const double size = random.power_of_two(-10, 13);
    const double away = random.chance(0.5) ? 0 : random.power_of_two(0, 14) * size;
    oracle::SamplePair<D> pair;
    for (oracle::Sample<D>* shape : {&pair.a, &pair.b}) {
        const auto kind = static_cast<oracle::Kind>(random.below(static_cast<std::uint32_t>(oracle::kind_count)));
        const DVec<D> off_pivot = random.chance(0.5) ? DVec<D>(0.0) : random.in_cube<D>() * size;
        if (random.chance(0.25)) {
            Vec<D> half(static_cast<float>(0.05 * size));
            half[0] = static_cast<float>(size);
            const Box<D> rod{to_float(off_pivot), half};
            *shape =
                oracle::sample<D>(oracle::Kind::box, rod, oracle::box_between(rod.center - half, rod.center + half));
        } else {
            *shape =
                oracle::SampleGenerator<D>(oracle::Random(random.bits()), off_pivot, size * random.power_of_two(-2, 1))
                    .make(kind);
        }
    }
    const double max_distance = random.chance(0.5)   ? 2 * std::numbers::pi
                                : random.chance(0.5) ? std::numbers::pi / 4
                                                     : 0;
    const DVec<D> from = random.direction<D>() * away,
                  displacement = random.direction<D>() * (size * random.uniform(1, 5));
    Motion<D> a{{to_float(from), random.rotation<D>()},
                to_float(random.in_cube<D>() * size),
                random_turn<D>(random, max_distance)};
    Motion<D> b{{to_float(from + displacement), random.rotation<D>()},
                to_float(displacement * -random.uniform(0.6, 1.8) + random.in_cube<D>() * size),
                random_turn<D>(random, random.chance(0.2) ? 0 : max_distance)};
    return {std::move(pair), a, b};
}

struct Tally {
    int sweeps = 0, hits = 0;
    double worst = 0;  ///< the largest distance at a hit, as a fraction of the tolerance
};

/// Checks that the distance is never below `floor` before `end`. The steps are bounded by the speed of approach, and
/// are at least 1/1000 near contact.
template <int D>
void expect_not_deeper(const MovingPair<D>& moving, double end, double floor, const char* what) {
    for (double time = 0; time < end;) {
        const double distance = moving.distance(time);
        ASSERT_GE(distance, floor) << what << " at " << time << " of " << end;
        time += std::max(0.9 * (distance - floor) / std::max(moving.speed, 1e-30), 1e-3);
    }
}

template <int D>
void check(const MovingPair<D>& moving, Tally& tally) {
    if (moving.distance(0) <= moving.margin) return;
    const std::optional<Hit<D>> hit = moving.sweep();
    ++tally.sweeps;
    expect_not_deeper(moving, hit ? static_cast<double>(hit->fraction) : 1, -moving.margin, hit ? "late" : "missed");
    if (!hit) return;
    ++tally.hits;
    const oracle::Truth<D> there = moving.truth(static_cast<double>(hit->fraction));
    const double allowed = moving.margin + 6e-8 * moving.speed;
    EXPECT_LE(there.distance, allowed) << "not there yet";
    EXPECT_GE(there.distance, -moving.margin) << "late";
    tally.worst = std::max(tally.worst, std::abs(there.distance) / allowed);
    EXPECT_FALSE(hit->started_inside);
    // The normal faces A, and separates the shapes at the hit.
    EXPECT_TRUE(std::abs(length(DVec<D>(hit->normal)) - 1) < 1e-6);
    Affine<D> place_a = place_at(moving.path_a, static_cast<double>(hit->fraction)),
              place_b = place_at(moving.path_b, static_cast<double>(hit->fraction));
    const DVec<D> origin = place_a.offset;
    place_b.offset -= origin;
    place_a.offset = DVec<D>(0.0);
    const auto solid_a = mapped(moving.pair.a.solid, place_a), solid_b = mapped(moving.pair.b.solid, place_b);
    EXPECT_GE(oracle::gap_along_with_radii(solid_a, solid_b, -DVec<D>(hit->normal)),
              -moving.margin - 2e-7 * (oracle::size(solid_a) + oracle::size(solid_b)));
    // The point is on B.
    place_b.offset += origin;
    EXPECT_LE(oracle::distance_to_surface(mapped(moving.pair.b.solid, place_b), hit->point),
              allowed + oracle::rounding_of(hit->point));
}

template <int D>
void check_many(int count, std::uint64_t first_seed) {
    Tally tally;
    for (int i = 0; i < oracle::case_count(count); ++i) {
        const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        check(random_motion<D>(random), tally);
        if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(tally.hits, tally.sweeps * 3 / 10);
    EXPECT_LT(tally.hits, tally.sweeps * 7 / 10);
    EXPECT_GT(tally.sweeps, oracle::case_count(count) * 6 / 10);
    testing::Test::RecordProperty("max_error_ratio", std::to_string(tally.worst));
}

TEST(SweepRotatingOracle, InThePlane) {
    check_many<2>(1000, 1);
}
TEST(SweepRotatingOracle, InSpace) {
    check_many<3>(1000, 1);
}

// Sweeps that start touching, after a move along the closest points: no overlap may grow without a hit.

template <int D>
MovingPair<D> touching(MovingPair<D> moving, bool backwards) {
    // Most pairs approach each other; here half of them should separate.
    if (backwards) {
        moving.motion_b.move = -moving.motion_b.move;
        moving.motion_a.move = -moving.motion_a.move;
        moving.path_a = rigid_path(moving.motion_a);
    }
    for (int round = 0; round < 3; ++round) {
        const oracle::Truth<D> now = moving.truth(0);
        moving.motion_b.from.position -= to_float(now.normal * now.distance);
        moving.path_b = rigid_path(moving.motion_b);
    }
    return moving;
}

/// A pair with a hit at 0 is soon deeper than at the start.
template <int D>
void expect_goes_in_at_once(const MovingPair<D>& moving, double first) {
    const double soon = 1e-3 * oracle::size(moving.pair.a.solid) / moving.speed;
    double least = first;
    for (const double time : {0.001 * soon, 0.01 * soon, 0.1 * soon, soon})
        least = std::min(least, moving.distance(std::min(time, 1.0)));
    EXPECT_LT(least, first) << "hit at 0, but moves apart or out";
}

struct TouchingTally {
    int sweeps = 0, at_once = 0, later = 0;
};

template <int D>
void check_touching(const MovingPair<D>& moving, TouchingTally& tally) {
    const double first = moving.distance(0);
    if (std::abs(first) > 0.4 * moving.margin) return;
    const std::optional<Hit<D>> hit = moving.sweep();
    ++tally.sweeps;
    const double end = hit ? static_cast<double>(hit->fraction) : 1;
    expect_not_deeper(moving, end, std::min(first, 0.0) - moving.margin, hit ? "late" : "missed");
    if (!hit) return;
    if (end > 0) {
        ++tally.later;
        EXPECT_LE(std::abs(moving.distance(end)), moving.margin * 1.4 + 6e-8 * moving.speed);
        return;
    }
    // The depth grows at once.
    ++tally.at_once;
    expect_goes_in_at_once(moving, first);
}

template <int D>
void check_many_touching(int count) {
    TouchingTally tally;
    for (int i = 0; i < oracle::case_count(count); ++i) {
        const std::uint64_t seed = 5000 + static_cast<std::uint64_t>(i);
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        check_touching(touching(random_motion<D>(random), i % 2 == 0), tally);
        if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(tally.sweeps, oracle::case_count(count) / 4);
    EXPECT_GT(tally.at_once, tally.sweeps * 3 / 10);
    EXPECT_LT(tally.at_once, tally.sweeps * 8 / 10);
    EXPECT_GT(tally.later, 0);
}

// Sweeps that start inside: a hit is a greater depth than at the start, or a touch after a separation, and nothing
// else.

template <int D>
MovingPair<D> inside(MovingPair<D> moving, double depth, bool on_the_spot) {
    moving.motion_b.from.position -= to_float(moving.truth(0).normal * depth);
    // Pairs that only rotate come back more often.
    if (on_the_spot) moving.motion_b.move = moving.motion_a.move;
    moving.path_b = rigid_path(moving.motion_b);
    return moving;
}

/// The error of depths by support functions.
template <int D>
double depth_error(const oracle::Sample<D>& shape) {
    return std::get<Convex<D>>(shape.view).core == Core::function ? 2e-3 * oracle::size(shape.solid) : 0;
}

struct InsideTally {
    int sweeps = 0, at_once = 0, deeper = 0, back = 0;
};

template <int D>
void check_inside(const MovingPair<D>& moving, InsideTally& tally) {
    const double first = moving.distance(0), margin = moving.margin;
    const double depth_tolerance = depth_error(moving.pair.a) + depth_error(moving.pair.b);
    if (first > -2 * margin) return;
    const std::optional<Hit<D>> hit = moving.sweep();
    ++tally.sweeps;
    const double end = hit ? static_cast<double>(hit->fraction) : 1;
    double max_distance = first;
    for (double time = 0; time < end;) {
        const double distance = moving.distance(time);
        max_distance = std::max(max_distance, distance);
        const double floor = (max_distance > margin ? 0 : first - depth_tolerance) - margin;
        ASSERT_GE(distance, floor) << (hit ? "late" : "missed") << " at " << time << " of " << end;
        const double free = std::min(distance - floor, max_distance > margin ? distance - floor : margin - distance);
        time += std::max(0.9 * free / std::max(moving.speed, 1e-30), 1e-3);
    }
    if (!hit) return;
    EXPECT_TRUE(hit->started_inside);
    if (end > 0) {
        const double there = moving.distance(end), allowed = 1.4 * margin + 6e-8 * moving.speed;
        const bool deeper = std::abs(there - first) <= allowed + depth_tolerance, back = std::abs(there) <= allowed;
        EXPECT_TRUE(deeper || back) << there / margin << " margins, at first " << first / margin;
        // The pair was apart at one of the sampled times.
        if (!deeper) {
            EXPECT_GT(max_distance + 1e-3 * moving.speed, 0.4 * margin);
        }
        ++(deeper ? tally.deeper : tally.back);
        return;
    }
    ++tally.at_once;
    expect_goes_in_at_once(moving, first);
}

template <int D>
void check_many_inside(int count) {
    InsideTally tally;
    for (int i = 0; i < oracle::case_count(count); ++i) {
        const std::uint64_t seed = 9000 + static_cast<std::uint64_t>(i);
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const MovingPair<D> beside = touching(random_motion<D>(random), i % 2 == 0);
        const double size = std::min(oracle::size(beside.pair.a.solid), oracle::size(beside.pair.b.solid));
        const bool on_the_spot = random.chance(0.7);
        check_inside(inside(beside, size * random.power_of_two(-15, -1), on_the_spot), tally);
        if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(tally.sweeps, oracle::case_count(count) / 2);
    EXPECT_GT(tally.at_once, tally.sweeps * 2 / 10);
    EXPECT_GT(tally.deeper, tally.sweeps / 100);
    EXPECT_GT(tally.back, tally.sweeps / 50);
}

TEST(SweepRotatingOracle, FromInsideInThePlane) {
    check_many_inside<2>(300);
}
TEST(SweepRotatingOracle, FromInsideInSpace) {
    check_many_inside<3>(150);
}

TEST(SweepRotatingOracle, FromTouchingInThePlane) {
    check_many_touching<2>(300);
}
TEST(SweepRotatingOracle, FromTouchingInSpace) {
    check_many_touching<3>(300);
}

}  // namespace
}  // namespace abut
