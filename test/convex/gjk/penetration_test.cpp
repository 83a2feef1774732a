// The start of EPA has no influence on its answer, but on its cost.

#include "../../oracle/random.hpp"
#include <abut/convex/gjk/epa.hpp>
#include <abut/convex/gjk/gjk.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polyhedron.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

Polyhedron round_hull(oracle::Random& random) {
    std::vector<Vec3> points;
    for (int i = 0; i < 32; ++i) points.push_back(to_float<3>(random.direction<3>()));
    return *Polyhedron::build(points);
}

/// Both have radius 1; this is the distance of their centers.
Pose3 near_pose(oracle::Random& random, double from, double to) {
    return {to_float<3>(random.direction<3>() * random.uniform(from, to)), random.rotation<3>()};
}

std::size_t steps_of(const Trace<3>& trace) {
    std::size_t result = 0;
    for (const TraceStep<3>& step : trace.steps) result += std::holds_alternative<PenetrationStep<3>>(step) ? 1 : 0;
    return result;
}

TEST(Penetration, IsTheSameFromAnyStart) {
    oracle::Random random(1);
    int started = 0;
    for (int i = 0; i < 500; ++i) {
        SCOPED_TRACE(i);
        const Polyhedron a = round_hull(random), b = round_hull(random);
        const CoreDifference<3> difference(convex(a), convex(b, affine(near_pose(random, 0.05, 1.6))));
        const GjkResult<3> walk = gjk(difference);
        const EpaResult<3> fresh = epa(difference), begun = epa(difference, {}, &walk.simplex);
        EXPECT_NEAR(begun.depth, fresh.depth, 1e-7);
        EXPECT_EQ(begun.exit, EpaExit::exact);
        started += walk.simplex.count == 4 ? 1 : 0;
    }
    EXPECT_GT(started, 400);
}

TEST(Penetration, CachesTheTetrahedronOfFaceAndOrigin) {
    oracle::Random random(2);
    std::size_t cold = 0, warm = 0, cached = 0;
    for (int i = 0; i < 500; ++i) {
        SCOPED_TRACE(i);
        const Polyhedron a = round_hull(random), b = round_hull(random);
        const CoreDifference<3> difference(convex(a), convex(b, affine(near_pose(random, 1.6, 1.85))));
        Cache cache;
        Trace<3> first;
        const EpaResult<3> found = epa(difference, {&cache, &first});
        if (found.depth < 0 || cache.count != 4) continue;
        ++cached;
        const GjkResult<3> walk = gjk(difference, std::numeric_limits<double>::infinity(), {.cache = &cache});
        EXPECT_EQ(walk.exit, GjkExit::overlapping);
        Trace<3> again;
        EXPECT_NEAR(epa(difference, {nullptr, &again}, &walk.simplex).depth, found.depth, 1e-7);
        cold += steps_of(first);
        warm += steps_of(again);
    }
    EXPECT_GT(cached, 300u);
    EXPECT_LT(2 * warm, cold);
}

}  // namespace
}  // namespace abut
