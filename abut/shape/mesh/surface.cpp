#include <abut/convex/bucket_sort.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/union_find.hpp>
#include <abut/shape/mesh/surface.hpp>

#include <algorithm>

namespace abut::detail {
namespace {

/// A half-edge among those with the same lower end: the higher end, its index, and whether it starts at the lower end.
/// It has half the size of a HalfEdge, since memory takes most of the time. There are fewer than 2^31 points.
struct SideKey {
    static std::uint64_t key(std::uint32_t high, std::uint32_t side, bool upwards) {
        return std::uint64_t{high} << 33 | std::uint64_t{side} << 1 | (upwards ? 1u : 0u);
    }
    static std::uint64_t high(std::uint64_t key) { return key >> 33; }
    static std::uint32_t side(std::uint64_t key) { return static_cast<std::uint32_t>(key >> 1); }
    static bool is_upwards(std::uint64_t key) { return (key & 1) != 0; }
};

}  // namespace

MeshAdjacency build_mesh_adjacency(std::span<const glm::uvec3> triangles, std::span<const std::uint32_t> same) {
    MeshAdjacency result;
    result.neighbours.assign(triangles.size(), {no_neighbour, no_neighbour, no_neighbour});
    result.closed = true;
    const auto each_side = [&](const auto& visit) {
        const auto add = [&](std::uint32_t from, std::uint32_t to, std::uint32_t side) {
            if (from != to) visit(std::min(from, to), SideKey::key(std::max(from, to), side, from < to));
        };
        std::uint32_t side = 0;
        for (const glm::uvec3& t : triangles) {
            const std::uint32_t a = same[t.x], b = same[t.y], c = same[t.z];
            add(a, b, side);
            add(b, c, side + 1);
            add(c, a, side + 2);
            side += 3;
        }
    };
    const Buckets by_low_end = in_buckets(same.size(), each_side);
    const auto neighbour = [&](std::uint64_t key) -> std::uint32_t& {
        return result.neighbours[SideKey::side(key) / 3][SideKey::side(key) % 3];
    };
    const auto add_edge = [&](std::span<const std::uint64_t> edge) {
        int balance = 0;
        for (const std::uint64_t side : edge) balance += SideKey::is_upwards(side) ? 1 : -1;
        result.closed = result.closed && balance == 0;
        if (edge.size() > 2) {
            for (const std::uint64_t side : edge) neighbour(side) = many_neighbours;
        } else if (edge.size() == 2 && SideKey::side(edge[0]) / 3 != SideKey::side(edge[1]) / 3) {
            neighbour(edge[0]) = SideKey::side(edge[1]) / 3;
            neighbour(edge[1]) = SideKey::side(edge[0]) / 3;
        }
    };
    for (std::size_t low = 0; low < same.size(); ++low) {
        const std::span<const std::uint64_t> sides = by_low_end.bucket(low);
        for (std::size_t begin = 0; begin < sides.size();) {
            std::size_t end = begin + 1;
            while (end < sides.size() && SideKey::high(sides[end]) == SideKey::high(sides[begin])) ++end;
            add_edge(sides.subspan(begin, end - begin));
            begin = end;
        }
    }
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
