// The oracle of convex parts itself, with known answers.

#include "../oracle/bake/part_quality.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

/// The corners and triangles of a soup_box, wound outwards.
struct Soup {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
};

Soup soup_box(const Vec3& low, const Vec3& high) {
    Soup result;
    for (int i = 0; i < 8; ++i)
        result.points.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    for (const glm::uvec4& q : {glm::uvec4(0, 2, 3, 1), glm::uvec4(4, 5, 7, 6), glm::uvec4(0, 1, 5, 4),
                                glm::uvec4(2, 6, 7, 3), glm::uvec4(0, 4, 6, 2), glm::uvec4(1, 3, 7, 5)}) {
        result.triangles.emplace_back(q.x, q.y, q.z);
        result.triangles.emplace_back(q.x, q.z, q.w);
    }
    return result;
}

Polyhedron solid_box(const Vec3& low, const Vec3& high) {
    return *Polyhedron::build(soup_box(low, high).points);
}

constexpr std::uint32_t samples = 20000;
constexpr double by_chance = 0.03;

TEST(PartQuality, WhatIsThereAndNoMoreIsFoundExact) {
    const Soup soup = soup_box(Vec3(0), Vec3(2, 1, 1));
    const std::vector<Polyhedron> halves = {solid_box(Vec3(0), Vec3(1)), solid_box(Vec3(1, 0, 0), Vec3(2, 1, 1))};
    const oracle::PartQuality found = oracle::quality_of(soup.points, soup.triangles, halves, samples, 1);
    EXPECT_EQ(found.extra, 0);
    EXPECT_EQ(found.missing, 0);
    EXPECT_EQ(found.uncovered, 0);
    EXPECT_EQ(found.farthest, 0);
    EXPECT_EQ(found.corners, 8u);
    EXPECT_EQ(found.all_corners, 16u);
    EXPECT_GT(found.samples_inside, 0.9 * samples);
}

TEST(PartQuality, MissingAndExtraVolumesAreReported) {
    const Soup soup = soup_box(Vec3(0), Vec3(2, 1, 1));
    // A quarter is uncovered, and half of the volume sticks out to the left.
    const std::vector<Polyhedron> parts = {solid_box(Vec3(-1, 0, 0), Vec3(1.5f, 1, 1))};
    const oracle::PartQuality found = oracle::quality_of(soup.points, soup.triangles, parts, samples, 2);
    EXPECT_NEAR(found.extra, 0.5, by_chance);
    EXPECT_NEAR(found.missing, 0.25, by_chance);
    EXPECT_NEAR(found.uncovered, 3.0 / 10, by_chance);  // four sides of 0.5 and the end of 1, of 10 in all
    EXPECT_NEAR(found.farthest, 0.5 / std::sqrt(6.0), 0.01);
}

TEST(PartQuality, AnOpenMeshHasOnlyItsSurface) {
    Soup soup = soup_box(Vec3(0), Vec3(1));
    soup.triangles.resize(2);
    const std::vector<Polyhedron> parts = {*Polyhedron::build(std::span(soup.points).first(4))};
    const oracle::PartQuality found = oracle::quality_of(soup.points, soup.triangles, parts, samples, 3);
    EXPECT_EQ(found.extra, 0);
    EXPECT_EQ(found.uncovered, 0);
    EXPECT_LT(found.farthest, 1e-6);
}

}  // namespace
}  // namespace abut
