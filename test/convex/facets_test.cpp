#include "hull/point_sets.hpp"
#include <abut/convex/facets.hpp>
#include <abut/convex/hull/hull.hpp>

#include <algorithm>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Edge = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

std::vector<Edge> as_tuples(std::span<const detail::FacetEdge> edges) {
    std::vector<Edge> result;
    for (const detail::FacetEdge& edge : edges) result.emplace_back(edge.from, edge.to, edge.left, edge.right);
    return result;
}

TEST(FacetEdges, OfATetrahedron) {
    const std::vector<std::uint32_t> loops{0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2}, ends{3, 6, 9, 12};
    EXPECT_EQ(as_tuples(detail::facet_edges(loops, ends)),
              (std::vector<Edge>{{0, 1, 0, 2}, {0, 2, 1, 0}, {0, 3, 2, 1}, {1, 2, 0, 3}, {1, 3, 3, 2}, {2, 3, 1, 3}}));
}

TEST(FacetEdges, OfASquareWithTwoSides) {
    const std::vector<std::uint32_t> loops{0, 1, 3, 2, 0, 2, 3, 1}, ends{4, 8};
    EXPECT_EQ(as_tuples(detail::facet_edges(loops, ends)),
              (std::vector<Edge>{{0, 1, 0, 1}, {0, 2, 1, 0}, {1, 3, 0, 1}, {2, 3, 1, 0}}));
}

TEST(FacetEdges, OfNothingAreNone) {
    EXPECT_TRUE(detail::facet_edges({}, {}).empty());
}

TEST(FacetEdges, OfEveryHullRunAlongBothTheirFaces) {
    std::size_t edges = 0;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (std::uint64_t round = 0; round < 4; ++round) {
            const std::uint64_t seed = 1000 * kind + round;
            SCOPED_TRACE(kinds[kind].name + ", seed " + std::to_string(seed));
            Random random(seed);
            const detail::Hull3 hull = *abut::detail::hull(kinds[kind].make(random));
            const detail::Facets facets{hull.normals, hull.loops, hull.loop_ends, hull.edges};
            const auto runs_along = [&](std::uint32_t face, std::uint32_t from, std::uint32_t to) {
                const std::span<const std::uint32_t> loop = facets.loop(face);
                for (std::size_t i = 0; i < loop.size(); ++i)
                    if (loop[i] == from && loop[(i + 1) % loop.size()] == to) return true;
                return false;
            };
            EXPECT_EQ(2 * hull.edges.size(), hull.loops.size());
            for (const detail::FacetEdge& edge : hull.edges) {
                EXPECT_LT(edge.from, edge.to);
                ASSERT_LT(std::max(edge.left, edge.right), hull.normals.size());
                EXPECT_TRUE(runs_along(edge.left, edge.from, edge.to));
                EXPECT_TRUE(runs_along(edge.right, edge.to, edge.from));
            }
            const std::vector<Edge> tuples = as_tuples(hull.edges);
            EXPECT_TRUE(std::is_sorted(tuples.begin(), tuples.end()));
            EXPECT_EQ(std::adjacent_find(tuples.begin(), tuples.end()), tuples.end());
            edges += hull.edges.size();
        }
    EXPECT_GT(edges, 5000u);
}

}  // namespace
}  // namespace abut::test
