#include <abut/bake/field/surface.hpp>
#include <abut/bake/repair/orientation.hpp>
#include <abut/math/predicates.hpp>
#include <abut/shape/mesh/half_edges.hpp>

#include <algorithm>
#include <utility>

namespace abut::detail {
namespace {

/// An edge that the surface traverses more often in this direction than in the other, once for each excess.
struct OpenEdge {
    std::uint32_t from = 0, to = 0;
};

struct OpenEdges {
    std::vector<OpenEdge> open_edges;  ///< sorted by `from`, then by `to`
    std::size_t edges = 0;
};

OpenEdges open_edges_of(std::span<const glm::uvec3> triangles) {
    OpenEdges result;
    const std::vector<HalfEdge> sorted = sorted_half_edges(triangles);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        std::ptrdiff_t upwards = 0;
        for (const HalfEdge& side : edge) upwards += side.upwards ? 1 : -1;
        const OpenEdge open = upwards > 0 ? OpenEdge{edge[0].low, edge[0].high} : OpenEdge{edge[0].high, edge[0].low};
        result.open_edges.insert(result.open_edges.end(), static_cast<std::size_t>(std::abs(upwards)), open);
        result.edges += upwards != 0;
    });
    std::sort(result.open_edges.begin(), result.open_edges.end(),
              [](const OpenEdge& a, const OpenEdge& b) { return std::pair(a.from, a.to) < std::pair(b.from, b.to); });
    return result;
}

/// Triangulates the polygon between a loop and the chord from its first corner to its last, in the opposite
/// orientation. Recursive halving keeps most triangles small and close to the loop.
void cap_loop(std::span<const std::uint32_t> loop, std::vector<glm::uvec3>& cap) {
    std::vector<std::pair<std::size_t, std::size_t>> stack{{0, loop.size() - 1}};
    while (!stack.empty()) {
        const auto [first, last] = stack.back();
        stack.pop_back();
        if (last - first < 2) continue;
        const std::size_t middle = first + (last - first) / 2;
        cap.emplace_back(loop[last], loop[middle], loop[first]);
        stack.emplace_back(middle, last);
        stack.emplace_back(first, middle);
    }
}

/// Follows open edges to loops and caps them. At every point as many open edges begin as end, so every path returns. A
/// loop is closed when the path reaches one of its points again.
std::vector<glm::uvec3> cap_of(const std::vector<OpenEdge>& open_edges, std::size_t points) {
    constexpr std::uint32_t none = no_index;
    std::vector<glm::uvec3> result;
    std::vector<std::uint32_t> next(points, none), index_on_path(points, none), path;
    for (std::size_t i = open_edges.size(); i-- > 0;) next[open_edges[i].from] = static_cast<std::uint32_t>(i);
    const auto has_next = [&](std::uint32_t point) {
        return next[point] < open_edges.size() && open_edges[next[point]].from == point;
    };
    for (const OpenEdge& start : open_edges) {
        if (!has_next(start.from)) continue;
        path.assign(1, start.from);
        index_on_path[start.from] = 0;
        while (has_next(path.back())) {
            const std::uint32_t to = open_edges[next[path.back()]++].to;
            if (index_on_path[to] == none) {
                index_on_path[to] = static_cast<std::uint32_t>(path.size());
                path.push_back(to);
                continue;
            }
            const std::size_t first = index_on_path[to];
            cap_loop(std::span(path).subspan(first), result);
            for (std::size_t i = first + 1; i < path.size(); ++i) index_on_path[path[i]] = none;
            path.resize(first + 1);
        }
        index_on_path[path.back()] = none;
    }
    return result;
}

}  // namespace

Result<FieldSurface> field_surface(std::span<const Vec3> points, std::span<const glm::uvec3> triangles) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!is_finite(points[i])) return Problem{ProblemCode::not_finite, "a point of the mesh is not finite", i};
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (triangles[i][k] >= points.size())
                return Problem{ProblemCode::index_out_of_range, "a triangle names a point that doesn't exist", i};

    FieldSurface result;
    result.mesh = weld(points, triangles);
    OpenEdges open_edges = open_edges_of(result.mesh.triangles);
    if (open_edges.edges > 0) {
        const std::vector<glm::uvec3> original = result.mesh.triangles;
        orient_consistently(result.mesh);
        for (std::size_t i = 0; i < original.size(); ++i) result.rewound += result.mesh.triangles[i] != original[i];
        if (result.rewound > 0) open_edges = open_edges_of(result.mesh.triangles);
    }
    result.gaps = open_edges.edges;
    result.cap = cap_of(open_edges.open_edges, result.mesh.points.size());

    const std::vector<Vec3>& corners = result.mesh.points;
    for (std::uint32_t i = 0; i < result.mesh.triangles.size(); ++i) {
        const glm::uvec3& t = result.mesh.triangles[i];
        if (on_line(corners[t.x], corners[t.y], corners[t.z])) continue;
        result.nondegenerate.push_back(i);
        for (int k = 0; k < 3; ++k) result.box = merged(result.box, Aabb3{corners[t[k]], corners[t[k]]});
    }
    if (result.nondegenerate.empty())
        return Problem{ProblemCode::empty_input, "no triangle of the mesh has an area", 0};
    return result;
}

}  // namespace abut::detail
