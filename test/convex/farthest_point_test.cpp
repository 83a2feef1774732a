// The farthest point has one index with every SIMD target.

#include "../oracle/random.hpp"
#include "../oracle/simd_targets.hpp"
#include <abut/convex/farthest_point.hpp>
#include <abut/convex/point_soa.hpp>

#include <vector>

#include <gtest/gtest.h>
namespace abut {

using namespace detail;

namespace {

template <int D>
std::uint32_t one_by_one(const std::vector<Vec<D>>& points, const DVec<D>& direction) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < points.size(); ++i)
        if (dot(DVec<D>(points[i]), direction) > dot(DVec<D>(points[best]), direction)) best = i;
    return best;
}

class FarthestPoint : public oracle::BySimdTarget {
protected:
    template <int D>
    static void expect_the_first_of_the_farthest() {
        for (std::uint64_t seed = 0; seed < 2000; ++seed) {
            SCOPED_TRACE(seed);
            oracle::Random random(seed);
            const std::uint32_t count = 1 + random.below(random.chance(0.1) ? 1500 : 70);
            std::vector<Vec<D>> points;
            // Half of them are on a small lattice, where many are equally far.
            const bool lattice = random.chance(0.5);
            for (std::uint32_t i = 0; i < count; ++i) {
                DVec<D> point = random.in_cube<D>() * (lattice ? 2.0 : 1e4);
                if (lattice)
                    for (int k = 0; k < D; ++k) point[k] = std::floor(point[k]);
                points.push_back(to_float(point));
            }
            DVec<D> direction = random.in_cube<D>();
            if (lattice)
                for (int k = 0; k < D; ++k) direction[k] = std::floor(2 * direction[k]);
            const std::uint32_t expected = one_by_one<D>(points, direction);
            EXPECT_EQ(farthest_point(points, direction), expected);
            if constexpr (D == 3) {
                if (!(largest(direction) > 0)) continue;
                std::vector<float> memory(3 * padded_count(points.size()));
                const PointSoa lanes = make_soa(points, memory.data());
                EXPECT_EQ(farthest_point(lanes, direction), expected);
                // Magnitudes at which floats overflow or underflow.
                const double scale = random.power_of_two(-300, 300);
                EXPECT_EQ(farthest_point(lanes, direction * scale), one_by_one<D>(points, direction * scale));
            }
        }
    }
};

// Floats don't distinguish these points, doubles do: a float filter with too small an error bound returns another
// point.
TEST_P(FarthestPoint, IsFoundAmongThoseThatFloatsTakeForAsFar) {
    int hidden = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const DVec<3> direction = random.direction<3>(), across = perpendicular(direction);
        const DVec<3> other = cross(direction, across);
        std::vector<Vec3> points;
        for (int i = 0; i < 48; ++i)
            points.push_back(to_float<3>(direction * (1 + random.uniform(-3e-8, 3e-8)) +
                                         across * random.uniform(-1, 1) + other * random.uniform(-1, 1)));
        std::vector<float> memory(3 * padded_count(points.size()));
        const std::uint32_t expected = one_by_one<3>(points, direction);
        EXPECT_EQ(farthest_point(make_soa(points, memory.data()), direction), expected);
        const auto in_float = [&](const Vec3& p) {
            const Vec3 d = to_float(direction);
            return p.x * d.x + p.y * d.y + p.z * d.z;
        };
        for (const Vec3& point : points) hidden += in_float(point) > in_float(points[expected]) ? 1 : 0;
    }
    EXPECT_GT(hidden, 1000);
}

TEST_P(FarthestPoint, IsTheFirstOfThem) {
    expect_the_first_of_the_farthest<2>();
    expect_the_first_of_the_farthest<3>();
}

INSTANTIATE_TEST_SUITE_P(Targets, FarthestPoint, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace
}  // namespace abut
