// Points at equal positions, against a reference over all earlier points.

#include "../oracle/random.hpp"
#include <abut/math/detail/coincident.hpp>

#include <gtest/gtest.h>

namespace abut {
namespace {

TEST(Coincident, NamesTheLowestOfEachPosition) {
    oracle::Random random(1);
    std::vector<Vec3> points;
    for (int i = 0; i < 1000; ++i)
        points.emplace_back(static_cast<float>(random.below(6)) - 3, static_cast<float>(random.below(5)) * 1e-40f,
                            random.below(2) == 0 ? 0.0f : -0.0f);
    const std::vector<std::uint32_t> first = detail::first_coincident(points);
    int repeated = 0;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        std::uint32_t lowest = 0;
        while (points[lowest] != points[i]) ++lowest;
        ASSERT_EQ(first[i], lowest) << i;
        repeated += lowest != i ? 1 : 0;
    }
    EXPECT_EQ(repeated, 970) << "30 positions";
    EXPECT_TRUE(detail::first_coincident({}).empty());
}

}  // namespace
}  // namespace abut
