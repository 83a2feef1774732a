// The clipped ray is equal with every SIMD target, and with a reference plane by plane.

#include "../oracle/random.hpp"
#include "../oracle/simd_targets.hpp"
#include <abut/convex/ray/planes.hpp>

#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

class RayPlanes : public oracle::BySimdTarget {};

TEST_P(RayPlanes, AreCutOneByOne) {
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        // Half of them are on a small lattice, where many planes cut the ray at one point or are parallel to it.
        const bool lattice = random.chance(0.5);
        const auto some = [&] {
            DVec<3> result = random.in_cube<3>() * 2.0;
            if (lattice)
                for (int i = 0; i < 3; ++i) result[i] = std::floor(result[i]);
            return result;
        };
        std::vector<Vec3> normals;
        std::vector<double> offsets;
        for (std::uint32_t i = 1 + random.below(60); i > 0; --i) {
            normals.push_back(to_float(some()));
            offsets.push_back(some().x);
        }
        const DVec<3> origin = some(), direction = some();
        const double out = lattice ? 0 : 0.25;

        PlaneCut expected;
        expected.in = expected.out = normals.size();
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const double height = dot(DVec<3>(normals[i]), origin) - (offsets[i] + out);
            const double sinks = -dot(DVec<3>(normals[i]), direction);
            if (sinks > 0 && height / sinks > expected.cut.lower) {
                expected.cut.lower = height / sinks;
                expected.cut.slope_in = sinks;
                expected.in = i;
            }
            if (sinks < 0 && height / sinks < expected.cut.upper) {
                expected.cut.upper = height / sinks;
                expected.cut.slope_out = -sinks;
                expected.out = i;
            }
            if (sinks == 0) expected.beside = std::max(expected.beside, height);
        }
        const PlaneCut found = cut_by_planes(normals, offsets, out, origin, direction);
        EXPECT_EQ(found.cut.lower, expected.cut.lower);
        EXPECT_EQ(found.cut.upper, expected.cut.upper);
        EXPECT_EQ(found.cut.slope_in, expected.cut.slope_in);
        EXPECT_EQ(found.cut.slope_out, expected.cut.slope_out);
        EXPECT_EQ(found.beside, expected.beside);
        EXPECT_EQ(found.in, expected.in);
        EXPECT_EQ(found.out, expected.out);
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, RayPlanes, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace
}  // namespace abut
