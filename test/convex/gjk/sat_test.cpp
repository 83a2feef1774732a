// The separating axis test against the oracle, which tries all pairs of edges without the Gauss map.

#include "../../oracle/distance.hpp"
#include "../../oracle/pair.hpp"
#include <abut/convex/features.hpp>
#include <abut/convex/gjk/sat.hpp>
#include <abut/shape/cylinder.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

template <int D, class A, class B>
CoreDifference<D> difference(const A& a, const B& b) {
    return {view(a), view(b)};
}

TEST(Sat, FindsTheLeastOfFaceNormals) {
    const auto boxes = difference<3>(Box3{{0, 0, 0}, {1, 1, 1}}, Box3{{1.75f, 0.5f, 0}, {1, 2, 1}});
    const SeparatingAxis<3> axis = separating_axis(boxes);
    EXPECT_DOUBLE_EQ(axis.extent, 0.25);
    EXPECT_EQ(axis.normal, DVec<3>(1, 0, 0));
    const SeparatingAxis<2> left =
        separating_axis(difference<2>(Box2{{0, 0}, {3, 1}}, Box2{{-2.5f, 0.5f}, {1, 1.25f}}));
    EXPECT_DOUBLE_EQ(left.extent, 1.5);
    EXPECT_EQ(left.normal, DVec<2>(-1, 0));
}

TEST(Sat, TriesEdgesAgainstEdges) {
    // Two crossed bars, each standing on an edge: only the cross product of edges separates them.
    const Box3 a{{0, 0, 0}, {5, 1, 1}, glm::quat(std::cos(0.3926991f), std::sin(0.3926991f), 0, 0)};
    const Box3 b{{0, 0, 2 * 1.4142135f + 0.1f}, {1, 5, 1}, glm::quat(std::cos(0.3926991f), 0, std::sin(0.3926991f), 0)};
    const SeparatingAxis<3> axis = separating_axis(difference<3>(a, b));
    EXPECT_NEAR(axis.extent, -0.1, 1e-5);
    EXPECT_NEAR(axis.normal.z, 1, 1e-6);
}

TEST(Sat, EndsAtAGapThatIsWideEnough) {
    Trace<3> all, few;
    const auto boxes = difference<3>(Box3{{0, 0, 0}, {1, 1, 1}}, Box3{{9, 0.5f, 0}, {1, 2, 1}});
    separating_axis(boxes, std::numeric_limits<double>::infinity(), &all);
    const SeparatingAxis<3> axis = separating_axis(boxes, 6.5, &few);
    EXPECT_EQ(axis.extent, -7);
    EXPECT_EQ(few.steps.size(), 1u);
    EXPECT_GT(all.steps.size(), 5u);
    const auto& step = std::get<AxisStep<3>>(few.steps[0]);
    EXPECT_EQ(step.axis, Vec3(1, 0, 0));
    EXPECT_EQ(step.max_a, 1);
    EXPECT_EQ(step.min_b, 8);
    EXPECT_EQ(step.gap(), 7);
}

TEST(Sat, KnowsWhatIsAPolytope) {
    EXPECT_TRUE(has_features<3>(view(Box3{{0, 0, 0}, {1, 1, 1}})));
    EXPECT_TRUE(has_features<3>(view(Segment<3>{{0, 0, 0}, {1, 1, 1}})));
    EXPECT_FALSE(has_features<3>(view(Cylinder{{0, 0, 0}, {1, 1, 1}, 1})));
    EXPECT_FALSE(has_features<3>(view(stretched(Sphere{{0, 0, 0}, 1}, Vec3(1, 2, 3)))));
}

template <class T>
class SatOracle : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SatOracle, Dimensions);

TYPED_TEST(SatOracle, AgreesOnThePairsThatOverlap) {
    constexpr int D = TypeParam::value;
    using oracle::Kind;
    int pairs = 0, overlapping = 0;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(3000)); ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        constexpr Kind kinds[] = {Kind::box, Kind::polytope, Kind::triangle, Kind::stretched_box};
        const Kind kind_a = kinds[random.below(4)], kind_b = kinds[random.below(4)];
        const auto pair = oracle::random_pair<D>(random, kind_a, kind_b);
        const CoreDifference<D> cores(std::get<Convex<D>>(pair.a.view), std::get<Convex<D>>(pair.b.view));
        const SeparatingAxis<D> found = separating_axis(cores);
        const oracle::Truth<D> truth = oracle::truth(pair.a.solid, pair.b.solid);
        const double tolerance = oracle::tolerance_for(pair.a.solid, pair.b.solid);
        ++pairs;
        EXPECT_NEAR(length(found.normal), 1, 1e-12);
        if (truth.overlap) {
            ++overlapping;
            EXPECT_NEAR(found.extent, -truth.distance, tolerance);
        } else {
            EXPECT_LE(-found.extent, truth.distance + tolerance);
            EXPECT_LE(found.extent, tolerance);
        }
        EXPECT_NEAR(oracle::gap_along(pair.a.solid, pair.b.solid, found.normal), -found.extent, tolerance);
    }
    EXPECT_GT(overlapping, pairs * 3 / 10);
    EXPECT_LT(overlapping, pairs * 7 / 10);
}

}  // namespace
}  // namespace abut
