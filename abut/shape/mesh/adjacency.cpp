#include <abut/shape/mesh/adjacency.hpp>

#include <algorithm>
#include <tuple>

namespace abut::detail {
namespace {

/// One use of an edge by a triangle: its higher point, the triangle, the side, and the direction.
struct EdgeUse {
    std::uint32_t high;
    std::uint32_t triangle;
    std::uint8_t side;
    bool upwards;
};

/// Links the triangles that share one edge. Returns the number of ascending minus the number of descending uses.
int link_neighbours(std::span<const EdgeUse> edges, MeshAdjacency& adjacency) {
    int balance = 0;
    for (const EdgeUse& edge : edges) balance += edge.upwards ? 1 : -1;
    const auto neighbour = [&](const EdgeUse& edge) -> std::uint32_t& {
        return adjacency.neighbours[edge.triangle][edge.side];
    };
    if (edges.size() > 2) {
        for (const EdgeUse& edge : edges) neighbour(edge) = many_neighbours;
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
    // A counting sort by the lower point; each point has few edges.
    const auto each_edge = [&](auto visit) {
        for (std::uint32_t t = 0; t < triangles.size(); ++t)
            for (std::uint8_t side = 0; side < 3; ++side) {
                const std::uint32_t from = same[triangles[t][side]], to = same[triangles[t][(side + 1) % 3]];
                if (from != to) visit(std::min(from, to), EdgeUse{std::max(from, to), t, side, from < to});
            }
    };
    std::vector<std::size_t> end(same.size() + 1);
    each_edge([&](std::uint32_t low, const EdgeUse&) { ++end[low + 1]; });
    for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
    std::vector<EdgeUse> edges(end.back());
    // end[low] is the start of the bucket before it is filled, and its end afterwards.
    each_edge([&](std::uint32_t low, const EdgeUse& edge) { edges[end[low]++] = edge; });
    result.closed = true;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < same.size(); begin = end[i++]) {
        const auto first = edges.begin() + static_cast<std::ptrdiff_t>(begin),
                   last = edges.begin() + static_cast<std::ptrdiff_t>(end[i]);
        std::sort(first, last, [](const EdgeUse& a, const EdgeUse& b) {
            return std::tie(a.high, a.triangle, a.side) < std::tie(b.high, b.triangle, b.side);
        });
        for (auto from = first; from != last;) {
            const auto to = std::find_if(from, last, [&](const EdgeUse& edge) { return edge.high != from->high; });
            if (link_neighbours({from, to}, result) != 0) result.closed = false;
            from = to;
        }
    }
    return result;
}

}  // namespace abut::detail
