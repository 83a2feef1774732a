#include <abut/shape/mesh_adjacency.hpp>

#include <algorithm>
#include <tuple>

namespace abut {
namespace {

/// An edge as one of its triangles has it: its higher point, whether that one comes second, and whose it is.
struct HalfEdge {
    std::uint32_t high;
    std::uint32_t triangle;
    std::uint8_t side;
    bool upwards;
};

/// Those from one point to one higher one: tells their triangles of one another. Returns how many more of them go
/// upwards than downwards.
int join(std::span<const HalfEdge> edges, MeshAdjacency& adjacency) {
    int balance = 0;
    for (const HalfEdge& edge : edges) balance += edge.upwards ? 1 : -1;
    const auto neighbour = [&](const HalfEdge& edge) -> std::uint32_t& {
        return adjacency.neighbours[edge.triangle][edge.side];
    };
    if (edges.size() > 2) {
        for (const HalfEdge& edge : edges) neighbour(edge) = many_neighbours;
    } else if (edges.size() == 2 && edges[0].triangle != edges[1].triangle) {
        neighbour(edges[0]) = edges[1].triangle;
        neighbour(edges[1]) = edges[0].triangle;
    }
    return balance;
}

}  // namespace

MeshAdjacency build_mesh_adjacency(std::span<const glm::uvec3> triangles, std::span<const std::uint32_t> same) {
    MeshAdjacency result;
    result.neighbours.assign(triangles.size(), {no_neighbour, no_neighbour, no_neighbour});
    // The edges are dealt out to their lower points, each of which has few.
    const auto each_edge = [&](auto visit) {
        for (std::uint32_t t = 0; t < triangles.size(); ++t)
            for (std::uint8_t side = 0; side < 3; ++side) {
                const std::uint32_t from = same[triangles[t][side]], to = same[triangles[t][(side + 1) % 3]];
                if (from != to) visit(std::min(from, to), HalfEdge{std::max(from, to), t, side, from < to});
            }
    };
    std::vector<std::size_t> end(same.size() + 1);
    each_edge([&](std::uint32_t low, const HalfEdge&) { ++end[low + 1]; });
    for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
    std::vector<HalfEdge> edges(end.back());
    // Filled from its beginning, a point's share ends where it should: one place on.
    each_edge([&](std::uint32_t low, const HalfEdge& edge) { edges[end[low]++] = edge; });
    result.closed = true;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < same.size(); begin = end[i++]) {
        const auto first = edges.begin() + static_cast<std::ptrdiff_t>(begin),
                   last = edges.begin() + static_cast<std::ptrdiff_t>(end[i]);
        std::sort(first, last, [](const HalfEdge& a, const HalfEdge& b) {
            return std::tie(a.high, a.triangle, a.side) < std::tie(b.high, b.triangle, b.side);
        });
        for (auto from = first; from != last;) {
            const auto to = std::find_if(from, last, [&](const HalfEdge& edge) { return edge.high != from->high; });
            if (join({from, to}, result) != 0) result.closed = false;
            from = to;
        }
    }
    return result;
}

}  // namespace abut
