#include <abut/math/dvec.hpp>
#include <abut/math/union_find.hpp>
#include <abut/shape/mesh/half_edges.hpp>
#include <abut/shape/mesh/surface.hpp>

namespace abut::detail {

MeshAdjacency build_mesh_adjacency(std::span<const glm::uvec3> triangles, std::span<const std::uint32_t> same) {
    MeshAdjacency result;
    result.neighbours.assign(triangles.size(), {no_neighbour, no_neighbour, no_neighbour});
    result.closed = true;
    std::vector<glm::uvec3> welded;
    welded.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) welded.emplace_back(same[t.x], same[t.y], same[t.z]);
    const auto neighbour = [&](const HalfEdge& edge) -> std::uint32_t& {
        return result.neighbours[edge.side / 3][edge.side % 3];
    };
    const std::vector<HalfEdge> sorted = sorted_half_edges(welded);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        if (edge[0].low == edge[0].high) return;
        int balance = 0;
        for (const HalfEdge& side : edge) balance += side.upwards ? 1 : -1;
        result.closed = result.closed && balance == 0;
        if (edge.size() > 2) {
            for (const HalfEdge& side : edge) neighbour(side) = many_neighbours;
        } else if (edge.size() == 2 && edge[0].side / 3 != edge[1].side / 3) {
            neighbour(edge[0]) = edge[1].side / 3;
            neighbour(edge[1]) = edge[0].side / 3;
        }
    });
    return result;
}

void find_components(MeshSurface& surface) {
    UnionFind sets(surface.triangles.size());
    double volume = 0;
    const DVec<3> origin(surface.points[surface.triangles[0].x]);
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        for (const std::uint32_t neighbour : surface.adjacency.neighbours[i])
            if (neighbour != no_neighbour && neighbour != many_neighbours) sets.unite(i, neighbour);
        const glm::uvec3& t = surface.triangles[i];
        const DVec<3> a(surface.points[t.x]), b(surface.points[t.y]), c(surface.points[t.z]);
        volume += dot(cross(a - origin, b - origin), c - origin);
    }
    surface.inward = volume < 0;
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i)
        if (sets.find(i) == i) surface.components.push_back(i);
}

}  // namespace abut::detail
