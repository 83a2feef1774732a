// Sweeps with rotation of curved shapes: cylinders, cones, ellipsoids, and user-defined support functions, against the
// distance in fine steps of time.

#include "../../oracle/expect.hpp"
#include "../../oracle/random.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/detail/sweep/rotating.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>

namespace abut {

using namespace detail;

namespace {

/// A lens: all points within 1.25 of both (0, 0, 0.75) and (0, 0, -0.75).
struct Lens {
    [[maybe_unused]] friend Aabb3 bounds(const Lens&) { return {{-1, -1, -0.5f}, {1, 1, 0.5f}}; }
    friend Vec3 support(const Lens&, const Vec3& d) {
        const double along = std::abs(static_cast<double>(d.z));
        const double across = std::sqrt(static_cast<double>(d.x) * static_cast<double>(d.x) +
                                        static_cast<double>(d.y) * static_cast<double>(d.y));
        const double norm = std::sqrt(along * along + across * across);
        if (across > 0 && along * 1.25 < 0.75 * norm)
            return {static_cast<float>(static_cast<double>(d.x) / across),
                    static_cast<float>(static_cast<double>(d.y) / across), 0};
        const double height = 1.25 * along / norm - 0.75, wide = 1.25 / norm;
        return {static_cast<float>(wide * static_cast<double>(d.x)),
                static_cast<float>(wide * static_cast<double>(d.y)), static_cast<float>(d.z < 0 ? -height : height)};
    }
};

struct RoundTally {
    int sweeps = 0, hits = 0;
};

template <class A, class B>
void check(const A& a, const B& b, std::uint64_t seed, RoundTally& tally) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    oracle::Random random(seed);
    const DVec<3> displacement = random.direction<3>() * random.uniform(1.5, 4);
    const Motion3 of_a{{{0, 0, 0}, random.rotation<3>()},
                       to_float(random.in_cube<3>()),
                       to_float(random.direction<3>() * random.uniform(0, 6.28))};
    const Motion3 of_b{{to_float(displacement), random.rotation<3>()},
                       to_float(displacement * -random.uniform(0.3, 1.5) + random.in_cube<3>()),
                       to_float(random.direction<3>() * random.uniform(0, 6.28))};
    const RigidPath<3> path_a = rigid_path(of_a), path_b = rigid_path(of_b);
    const auto distance = [&](double time) {
        const View<3> there_a = moved(View<3>(view(a)), place_at(path_a, time)),
                      there_b = moved(View<3>(view(b)), place_at(path_b, time));
        return static_cast<double>(closest(there_a, there_b).distance);
    };
    if (distance(0) < 0.01) return;
    ++tally.sweeps;
    const auto hit = sweep(a, of_a, b, of_b);
    const double end = hit ? static_cast<double>(hit->fraction) : 1;
    for (int i = 0; i < 300; ++i) ASSERT_GE(distance(end * i / 300), -2e-5) << (hit ? "late" : "missed");
    RotatingImpact<3> impact;
    EXPECT_EQ(time_of_impact<3>(view(a), path_a, view(b), path_b, {.max_iterations = 100}, {}, impact),
              hit.has_value());
    if (!hit) return;
    ++tally.hits;
    EXPECT_NEAR(distance(end), 0, 2e-5);
}

template <class A, class B>
void check_many(const A& a, const B& b) {
    RoundTally tally;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) check(a, b, seed, tally);
    EXPECT_GT(tally.sweeps, 40);
    EXPECT_GT(tally.hits, tally.sweeps * 3 / 10);
    EXPECT_LT(tally.hits, tally.sweeps * 9 / 10);
}

const Cylinder drum{{0, 0, -0.5f}, {0, 0, 0.5f}, 0.8f};
const Cylinder coin{{0, 0, -0.02f}, {0, 0, 0.02f}, 1};
const Cone cone{{0, 0, -0.4f}, {0, 0, 1}, 0.6f};
const Box3 box{{0.2f, 0, 0}, {0.7f, 0.4f, 0.5f}};
const auto egg = stretched(Sphere{{0, 0, 0}, 1}, Vec3(0.4f, 0.6f, 1));

TEST(SweepRotatingRound, Cylinders) {
    check_many(drum, box);
    check_many(drum, coin);
    check_many(coin, coin);
}
TEST(SweepRotatingRound, Cones) {
    check_many(cone, box);
    check_many(cone, drum);
}
TEST(SweepRotatingRound, Ellipsoids) {
    check_many(egg, box);
    check_many(egg, egg);
}
TEST(SweepRotatingRound, AUsersShape) {
    check_many(Lens(), box);
    check_many(Lens(), drum);
    check_many(Lens(), Lens());
}

}  // namespace
}  // namespace abut
