// The separating axis test against the oracle, and which shapes are polytopes.

#include "../../oracle/distance.hpp"
#include "../../oracle/pair.hpp"
#include <abut/convex/features.hpp>
#include <abut/convex/gjk/sat.hpp>
#include <abut/shape/cylinder.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

template <class A, class B>
CoreDifference<2> difference(const A& a, const B& b) {
    return {view(a), view(b)};
}

TEST(Sat, FindsTheLeastOfFaceNormals) {
    const SeparatingAxis left = separating_axis(difference(Box2{{0, 0}, {3, 1}}, Box2{{-2.5f, 0.5f}, {1, 1.25f}}));
    EXPECT_DOUBLE_EQ(left.extent, 1.5);
    EXPECT_EQ(left.normal, DVec<2>(-1, 0));
}

TEST(Sat, EndsAtAGapThatIsWideEnough) {
    Trace<2> all, few;
    const auto boxes = difference(Box2{{0, 0}, {1, 1}}, Box2{{9, 0.5f}, {1, 2}});
    separating_axis(boxes, std::numeric_limits<double>::infinity(), &all);
    const SeparatingAxis axis = separating_axis(boxes, 6.5, &few);
    EXPECT_EQ(axis.extent, -7);
    EXPECT_EQ(few.steps.size(), 1u);
    EXPECT_GT(all.steps.size(), 3u);
    const auto& step = std::get<AxisStep<2>>(few.steps[0]);
    EXPECT_EQ(step.axis, Vec2(1, 0));
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

TEST(SatOracle, AgreesOnThePairsThatOverlap) {
    constexpr int D = 2;
    using oracle::Kind;
    int pairs = 0, overlapping = 0;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(3000)); ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        constexpr Kind kinds[] = {Kind::box, Kind::polytope, Kind::triangle, Kind::stretched_box};
        const Kind kind_a = kinds[random.below(4)], kind_b = kinds[random.below(4)];
        const auto pair = oracle::random_pair<D>(random, kind_a, kind_b);
        const CoreDifference<D> cores(std::get<Convex<D>>(pair.a.view), std::get<Convex<D>>(pair.b.view));
        const SeparatingAxis found = separating_axis(cores);
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
