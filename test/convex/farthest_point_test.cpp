// The same index from every kind of vector unit that this machine has.

#include "../oracle/random.hpp"
#include "../oracle/vector_units.hpp"
#include <abut/convex/farthest_point.hpp>
#include <abut/convex/point_lanes.hpp>

#include <vector>

#include <gtest/gtest.h>
namespace abut {
namespace {

template <int D>
std::uint32_t one_by_one(const std::vector<Vec<D>>& points, const DVec<D>& direction) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < points.size(); ++i)
        if (dot(DVec<D>(points[i]), direction) > dot(DVec<D>(points[best]), direction)) best = i;
    return best;
}

class FarthestPoint : public oracle::ByVectorUnit {
protected:
    template <int D>
    static void expect_the_first_of_the_farthest() {
        for (std::uint64_t seed = 0; seed < 2000; ++seed) {
            SCOPED_TRACE(seed);
            oracle::Random random(seed);
            const std::uint32_t count = 1 + random.below(random.chance(0.1) ? 1500 : 70);
            std::vector<Vec<D>> points;
            // Half of them on a small lattice, where many are equally far.
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
                const PointLanes lanes = lay_out(points, memory.data());
                EXPECT_EQ(farthest_point(lanes, direction), expected);
                // Where floats would run over, or under.
                const double scale = random.power_of_two(-300, 300);
                EXPECT_EQ(farthest_point(lanes, direction * scale), one_by_one<D>(points, direction * scale));
            }
        }
    }
};

TEST_P(FarthestPoint, IsTheFirstOfThem) {
    expect_the_first_of_the_farthest<2>();
    expect_the_first_of_the_farthest<3>();
}

INSTANTIATE_TEST_SUITE_P(Targets, FarthestPoint, oracle::vector_units(), oracle::name_of_unit);

}  // namespace
}  // namespace abut
