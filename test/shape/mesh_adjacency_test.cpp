#include "../oracle/pair.hpp"
#include "meshes.hpp"

#include <array>
#include <set>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Edge = std::array<std::array<float, 3>, 2>;

/// An edge by the positions of its ends, the lesser first; -0 counts as 0.
Edge edge_of(const Vec3& a, const Vec3& b) {
    const auto place = [](const Vec3& p) { return std::array<float, 3>{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; };
    return place(a) < place(b) ? Edge{place(a), place(b)} : Edge{place(b), place(a)};
}

/// A reference: compares every edge of every triangle with every other.
void check_neighbours(const Mesh& mesh, int& borders, int& seams, int& shared_by_many) {
    const auto count = static_cast<std::uint32_t>(mesh.triangles().size());
    const auto edge = [&](std::uint32_t t, std::uint32_t side) {
        const Triangle3 triangle = mesh.triangle(t);
        const std::array<Vec3, 4> corner{triangle.a, triangle.b, triangle.c, triangle.a};
        return edge_of(corner[side], corner[side + 1]);
    };
    for (std::uint32_t t = 0; t < count; ++t)
        for (std::uint32_t side = 0; side < 3; ++side) {
            const Edge mine = edge(t, side);
            std::uint32_t expected = no_neighbour;
            int others = 0;
            for (std::uint32_t other = 0; other < count; ++other)
                for (std::uint32_t i = 0; i < 3; ++i)
                    if (mine[0] != mine[1] && !(other == t && i == side) && edge(other, i) == mine) {
                        ++others;
                        if (other != t) expected = other;
                    }
            if (others > 1) expected = many_neighbours;
            ASSERT_EQ(mesh.neighbour(t, side), expected) << t << " " << side;
            (expected == no_neighbour ? borders : expected == many_neighbours ? shared_by_many : seams) += 1;
        }
}

TEST(MeshAdjacency, OfACubeIsAllSeams) {
    const Mesh cube = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    int borders = 0, seams = 0, shared_by_many = 0;
    check_neighbours(cube, borders, seams, shared_by_many);
    EXPECT_EQ(borders, 0);
    EXPECT_EQ(seams, 36);
    EXPECT_EQ(shared_by_many, 0);
    const auto* other = &cube;
    EXPECT_EQ(view(cube).neighbour(other, 0, 1), cube.neighbour(0, 1));
}

TEST(MeshAdjacency, WeldsPointsAtTheSamePosition) {
    // Two triangles with separate points; a coordinate of one of them is -0.
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0f, 1, 0}};
    const std::vector<glm::uvec3> triangles{{0, 1, 2}, {3, 4, 5}};
    const Mesh mesh = *Mesh::build(points, triangles);
    EXPECT_EQ(mesh.neighbour(0, 0), no_neighbour);
    EXPECT_EQ(mesh.neighbour(0, 1), 1u);
    EXPECT_EQ(mesh.neighbour(1, 2), 0u);
}

TEST(MeshAdjacency, SaysWhereThereIsNoSurface) {
    // Three fans about one edge, one of them reversed; a repeated triangle; one with an edge of length 0; one with an
    // edge and its reverse.
    const std::vector<Vec3> points{{0, 0, 0},  {0, 0, 1}, {1, 0, 0}, {0, 1, 0},
                                   {-1, 0, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
    const std::vector<glm::uvec3> triangles{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {5, 6, 7},
                                            {5, 6, 7}, {2, 2, 3}, {3, 4, 3}};
    const Mesh mesh = *Mesh::build(points, triangles);
    for (std::uint32_t fan = 0; fan < 3; ++fan) EXPECT_EQ(mesh.neighbour(fan, 0), many_neighbours);
    for (std::uint32_t side = 0; side < 3; ++side) EXPECT_EQ(mesh.neighbour(3, side), 4u);
    EXPECT_EQ(mesh.neighbour(5, 0), no_neighbour);
    EXPECT_EQ(mesh.neighbour(6, 0), no_neighbour);
    EXPECT_FALSE(mesh.closed());
    int borders = 0, seams = 0, shared_by_many = 0;
    check_neighbours(mesh, borders, seams, shared_by_many);
}

TEST(MeshAdjacency, AgreesWithTryingAllEdges) {
    int borders = 0, seams = 0, shared_by_many = 0;
    for (int seed = 0; seed < oracle::case_count(30); ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(static_cast<std::uint64_t>(seed));
        // Few positions, so that triangles share edges by chance, and points repeat.
        std::vector<Vec3> points;
        for (int i = 0; i < 16; ++i)
            points.emplace_back(static_cast<float>(random.below(3)), static_cast<float>(random.below(2)), 0.0f);
        std::vector<glm::uvec3> triangles;
        const auto some = [&] { return random.below(16); };
        for (int i = 0; i < 6; ++i) triangles.emplace_back(some(), some(), some());
        check_neighbours(*Mesh::build(points, triangles), borders, seams, shared_by_many);
        check_neighbours(random_terrain(random, 4, 1).surface().mesh(), borders, seams, shared_by_many);
        if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_TRUE(borders > 100 && seams > 100 && shared_by_many > 100)
        << borders << " " << seams << " " << shared_by_many;
}

}  // namespace
}  // namespace abut::test
