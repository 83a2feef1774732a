#include <abut/shape/weld.hpp>

#include <gtest/gtest.h>

namespace abut {
namespace {

TEST(Weld, MakesPointsAtOnePositionOne) {
    // A square of two triangles with separate corners, and an unused point.
    const std::vector<Vec3> points{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0f, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Welded welded = weld(points, std::vector<glm::uvec3>{{1, 2, 3}, {4, 5, 6}});
    EXPECT_EQ(welded.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(welded.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Weld, MakesMinusZeroZero) {
    const std::vector<Vec3> points{{-0.0f, -0.0f, -0.0f}, {1, 0, 0}, {0, 1, 0}};
    const Welded welded = weld(points, std::vector<glm::uvec3>{{0, 1, 2}});
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(std::signbit(welded.points[0][i]));
}

TEST(Weld, KeepsApartWhatDiffersByOneUlp) {
    const float next = std::nextafter(1.0f, 2.0f);
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {next, 0, 0}};
    const Welded welded = weld(points, std::vector<glm::uvec3>{{0, 1, 2}, {0, 3, 2}});
    EXPECT_EQ(welded.points.size(), 4u);
}

TEST(Weld, DropsTrianglesThatShrinkToALine) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const Welded welded = weld(points, std::vector<glm::uvec3>{{0, 1, 2}, {0, 1, 3}});
    EXPECT_EQ(welded.triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
    EXPECT_EQ(welded.points.size(), 3u);
}

TEST(Weld, TakesNothing) {
    const Welded welded = weld({}, {});
    EXPECT_TRUE(welded.points.empty());
    EXPECT_TRUE(welded.triangles.empty());
}

}  // namespace
}  // namespace abut
