// GJK and EPA: their exit codes, and that each result proves itself.

#include "../oracle/distance.hpp"
#include "../oracle/pair.hpp"
#include <abut/convex/gjk/epa.hpp>
#include <abut/convex/gjk/gjk.hpp>
#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

template <int D, class A, class B>
CoreDifference<D> difference(const A& a, const B& b) {
    return {view(a), view(b)};
}

TEST(Gjk, EndsAsThePairIs) {
    const Box3 box{{0, 0, 0}, {1, 1, 1}};
    const auto apart = gjk(difference<3>(box, Box3{{5, 0.5f, 0}, {1, 1, 1}}));
    EXPECT_EQ(apart.exit, GjkExit::separated);
    EXPECT_DOUBLE_EQ(apart.upper_bound, 3);
    EXPECT_TRUE(apart.converged());
    EXPECT_EQ(gjk(difference<3>(box, Box3{{1, 0.5f, 0.25f}, {1, 1, 1}})).exit, GjkExit::overlapping);
    EXPECT_EQ(gjk(difference<3>(Segment<3>{{0, 0, 0}, {1, 0, 0}}, Segment<3>{{1, 0, 0}, {2, 5, 0}})).exit,
              GjkExit::touching);
    EXPECT_EQ(gjk(difference<3>(Sphere{{1, 2, 3}, 0}, Sphere{{1, 2, 3}, 0})).exit, GjkExit::touching);
}

TEST(Gjk, StopsAsSoonAsYesOrNoIsKnown) {
    const auto far = difference<2>(Segment<2>{{0, -1}, {0, 1}}, Segment<2>{{5, -1}, {5, 1}});
    EXPECT_EQ(gjk(far, 4.99).exit, GjkExit::beyond);
    EXPECT_EQ(gjk(far, 5.01).exit, GjkExit::within);
}

TEST(Gjk, SaysWhereItStopsAtTheLastDigit) {
    // The squared distance is at its last digit here, and the plane isn't.
    const Triangle<3> needle{{-0.00684267143f, 0, -64}, {0.00684267143f, 0, -128}, {-0.00342133571f, 128, -128}};
    const auto stuck =
        gjk(difference<3>(needle, Segment<3>{{-0.00684267143f, -64, -128}, {0.00342133571f, -64, -128}}));
    EXPECT_EQ(stuck.exit, GjkExit::no_progress);
    EXPECT_TRUE(stuck.converged());
}

/// A support function whose answers contradict each other: no search can converge on it.
struct Restless {
    mutable oracle::Random random{1};
    double far;

    [[maybe_unused]] friend Aabb3 bounds(const Restless&) { return {{-1, -1, -1}, {1, 1, 1}}; }
    friend Vec3 support(const Restless& shape, const Vec3& direction) {
        return to_float(DVec<3>(direction) * shape.random.uniform(0.5, 1) + shape.random.in_cube<3>() +
                        DVec<3>(shape.far, 0, 0));
    }
};

TEST(Engines, EndOnANonsensicalSupportFunction) {
    for (const double far : {0.0, 1.0, 2.0, 10.0})
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            const Restless shape{oracle::Random(seed), far};
            const Sphere point{{0, 0, 0}, 0};
            const auto result = signed_distance<3>(view(shape), view(point));
            EXPECT_TRUE(std::isfinite(result.distance));
            EXPECT_NEAR(length(result.normal), 1, 1e-12);
            const auto deep = epa(difference<3>(shape, point));
            EXPECT_TRUE(std::isfinite(deep.depth));
            EXPECT_NEAR(length(deep.normal), 1, 1e-12);
            convex_overlap<3>(view(shape), view(point));
        }
}

TEST(Penetration, OfPolytopesIsExact) {
    const auto deep = epa(difference<3>(Box3{{0, 0, 0}, {1, 1, 1}}, Box3{{1.75f, 0.5f, 0}, {1, 2, 1}}));
    EXPECT_EQ(deep.exit, EpaExit::exact);
    EXPECT_DOUBLE_EQ(deep.depth, 0.25);
    EXPECT_EQ(deep.normal, DVec<3>(1, 0, 0));
    const auto flat = epa(difference<2>(Box2{{0, 0}, {3, 1}}, Box2{{0.5f, -0.5f}, {1, 1}}));
    EXPECT_EQ(flat.exit, EpaExit::exact);
    EXPECT_DOUBLE_EQ(flat.depth, 1.5);
    EXPECT_EQ(flat.normal, DVec<2>(0, -1));
}

TEST(Penetration, WithoutThicknessIsFlat) {
    const auto crossing = epa(difference<3>(Segment<3>{{-1, 0, 0}, {1, 0, 0}}, Segment<3>{{0, -1, 0}, {0, 1, 0}}));
    EXPECT_EQ(crossing.exit, EpaExit::flat);
    EXPECT_EQ(crossing.depth, 0);
    EXPECT_DOUBLE_EQ(std::abs(crossing.normal.z), 1);
    const auto in_a_row = epa(difference<3>(Segment<3>{{-1, 0, 0}, {1, 0, 0}}, Segment<3>{{0, 0, 0}, {5, 0, 0}}));
    EXPECT_EQ(in_a_row.exit, EpaExit::flat);
    EXPECT_EQ(in_a_row.depth, 0);
    EXPECT_DOUBLE_EQ(in_a_row.normal.x, 0);
    const auto points = epa(difference<2>(Circle{{1, 1}, 3}, Circle{{1, 1}, 2}));
    EXPECT_EQ(points.exit, EpaExit::flat);
    EXPECT_EQ(points.depth, 0);
}

TEST(Penetration, AtItsBoundIsStillAValidMove) {
    // A coin and a needle through its middle: the depth is half the needle's length, in nearly any direction.
    const Cylinder coin{{0, 0, 0}, {0, 0.001f, 0}, 1};
    const auto needle = stretched(Sphere{{0, 0, 0}, 1}, Vec3(0.001f, 1, 0.001f));
    const auto deep = epa(difference<3>(coin, needle));
    EXPECT_EQ(deep.exit, EpaExit::bound_reached);
    EXPECT_LT(deep.depth, 1.01);
    EXPECT_GE(deep.depth, 1);
    EXPECT_NEAR(dot(deep.normal, difference<3>(coin, needle).support(deep.normal).position), deep.depth, 1e-12);
}

template <class T>
class SignedDistanceOracle : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SignedDistanceOracle, Dimensions);

// In double, the searches are far more accurate than the tolerance, which is for floats.
TYPED_TEST(SignedDistanceOracle, IsRightToAMillionth) {
    constexpr int D = TypeParam::value;
    double worst = 0;
    int pairs = 0;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(10000)); ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const auto kind = [&] { return static_cast<oracle::Kind>(random.below(oracle::kind_count)); };
        const oracle::Kind kind_a = kind(), kind_b = kind();
        // These are rounded: a user's support function is in float, and a built hull may omit points.
        const auto rounds = [](oracle::Kind k) {
            return k == oracle::Kind::cloud || k == oracle::Kind::polytope || k == oracle::Kind::aabb;
        };
        if (rounds(kind_a) || rounds(kind_b)) continue;
        const auto pair = oracle::random_pair<D>(random, kind_a, kind_b);
        const auto found = signed_distance(std::get<Convex<D>>(pair.a.view), std::get<Convex<D>>(pair.b.view));
        const auto true_one = truth(pair.a.solid, pair.b.solid);
        const double scale = std::min(oracle::size(pair.a.solid), oracle::size(pair.b.solid)) +
                             1e-3 * largest_coordinate(pair.a.solid, pair.b.solid);
        const double error = std::abs(found.distance - true_one.distance) / scale;
        EXPECT_LE(error, 2e-6) << found.distance << " instead of " << true_one.distance;
        EXPECT_NEAR(length(found.normal), 1, 1e-12);
        worst = std::max(worst, error);
        ++pairs;
    }
    this->RecordProperty("pairs", pairs);
    this->RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
    EXPECT_GT(pairs, 3000);
}

}  // namespace
}  // namespace abut
