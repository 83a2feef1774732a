// Heights and planes are equal to the last bit with every SIMD target.

#include "../oracle/random.hpp"
#include "../oracle/simd_targets.hpp"
#include <abut/convex/hull/highest_plane.hpp>
#include <abut/math/dvec.hpp>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

class HighestPlane : public oracle::BySimdTarget {};

TEST_P(HighestPlane, IsTheFirstOfThem) {
    int ties = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        // Half of them are on a small lattice, where many planes are equally far below a point.
        const bool lattice = random.chance(0.5);
        const auto place = [&] {
            DVec<3> result = random.in_cube<3>() * (lattice ? 2.0 : 1e8);
            if (lattice)
                for (int i = 0; i < 3; ++i) result[i] = std::floor(result[i]);
            return result;
        };
        std::vector<Plane<3>> planes(1 + random.below(12));
        for (Plane<3>& plane : planes) {
            plane.normal = lattice ? place() : random.direction<3>();
            plane.offset = dot(plane.normal, place());
        }
        const std::size_t count = random.below(40);
        std::vector<double> columns[3], heights(count + highest_plane_padding), numbers(count + highest_plane_padding);
        for (std::vector<double>& column : columns) column.resize(count + highest_plane_padding);
        for (std::size_t i = 0; i < count; ++i) {
            const DVec<3> point = place();
            for (int k = 0; k < 3; ++k) columns[k][i] = point[k];
        }
        highest_planes(planes, {columns[0].data(), columns[1].data(), columns[2].data(), count}, heights.data(),
                       numbers.data());
        for (std::size_t i = 0; i < count; ++i) {
            const DVec<3> point(columns[0][i], columns[1][i], columns[2][i]);
            const auto height = [&](std::size_t plane) {
                return dot(planes[plane].normal, point) - planes[plane].offset;
            };
            std::size_t best = 0;
            for (std::size_t plane = 1; plane < planes.size(); ++plane) {
                ties += height(plane) == height(best) ? 1 : 0;
                if (height(plane) > height(best)) best = plane;
            }
            ASSERT_EQ(heights[i], height(best));
            ASSERT_EQ(numbers[i], static_cast<double>(best));
        }
    }
    EXPECT_GT(ties, 1000);
}

INSTANTIATE_TEST_SUITE_P(Targets, HighestPlane, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace
}  // namespace abut
