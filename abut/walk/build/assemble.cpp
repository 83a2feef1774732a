#include <abut/math/detail/coincident.hpp>
#include <abut/math/union_find.hpp>
#include <abut/walk/build/assemble.hpp>
#include <abut/walk/build/vertex_fans.hpp>

#include <utility>

namespace abut::detail {
namespace {

/// Sets the corners in space and in the triangle's frame.
void place(WalkTriangle& walk, const Welded& surface, const glm::uvec3& triangle) {
    for (int k = 0; k < 3; ++k) walk.corner[k] = surface.points[triangle[k]];
    const DVec<3> first(walk.corner[0]), along = DVec<3>(walk.corner[1]) - first,
                                         other = DVec<3>(walk.corner[2]) - first;
    const double width = length(along);
    walk.inverse_width = 1 / width;
    walk.third = dot(along, other) / width;
    walk.inverse_height = width / length(cross(along, other));
}

/// Sets the unfolded opposite corners of the neighbours.
void unfold(WalkTriangle& walk, const Welded& surface, std::span<const glm::uvec3> triangles,
            const std::array<WalkLink, 3>& links, const glm::uvec3& triangle) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        const WalkLink link = links[k];
        if (link.is_border()) continue;
        const auto at = [&](const glm::uvec3& of, std::uint32_t corner) {
            return DVec<3>(surface.points[of[static_cast<glm::length_t>(corner)]]);
        };
        const DVec<3> from = at(triangle, k), to = at(triangle, next_corner(k));
        const DVec<3> far = at(triangles[link.triangle()], next_corner(next_corner(link.side())));
        const DVec<3> side = to - from;
        const double square = length_squared(side);
        walk.back[k] = 0.5 - dot(far - from, side) / square;
        walk.away[k] = length(cross(side, far - from)) / square;
    }
}

/// Connected components, by union-find over linked triangles.
std::size_t find_components(const Walkable& walkable, const WalkLinks& links, std::vector<std::uint32_t>& components) {
    UnionFind groups(walkable.number.size());
    for (std::size_t i = 0; i < links.of.size(); ++i)
        for (const WalkLink& link : links.of[i])
            if (!link.is_border()) groups.unite(i, link.triangle());
    std::size_t count = 0;
    for (std::size_t i = 0; i < walkable.number.size(); ++i) {
        const std::size_t first = groups.find(i);
        components[walkable.number[i]] =
            first == i ? static_cast<std::uint32_t>(count++) : components[walkable.number[first]];
    }
    return count;
}

void set_normals(WalkMeshData& data, const Walkable& walkable, const WalkLinks& links) {
    if (data.given_normals) {
        data.corner_normals = data.triangles;
        return;
    }
    WalkNormals vertex_fans = fan_normals(walkable.surface.points, walkable.surface.triangles, links);
    data.normals = std::move(vertex_fans.normals);
    data.corner_normals.resize(data.triangles.size());
    for (std::size_t i = 0; i < walkable.number.size(); ++i)
        data.corner_normals[walkable.number[i]] = vertex_fans.of[i];
}

}  // namespace

void assemble(WalkMeshData& data, const Walkable& walkable, const WalkLinks& links, MeshTree tree) {
    const std::vector<glm::uvec3>& walked = walkable.surface.triangles;
    WalkMeshReport& report = data.report;
    report.non_manifold_edges = links.non_manifold_edges;
    report.mirrored = links.mirrored;
    report.border = links.border;
    report.non_manifold_vertices = non_manifold_vertices(walked, links).size();
    data.components.resize(data.triangles.size());
    report.components = find_components(walkable, links, data.components);
    for (std::size_t i = 0; i < walked.size(); ++i) {
        WalkTriangle& walk = data.walk[walkable.number[i]];
        place(walk, walkable.surface, walked[i]);
        unfold(walk, walkable.surface, walked, links.of[i], walked[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            const WalkLink link = links.of[i][k];
            if (!link.is_border())
                walk.link[k] = WalkLink::to(walkable.number[link.triangle()], link.side(), link.mirrored());
            data.bounds = merged(data.bounds, Aabb3{walk.corner[k], walk.corner[k]});
        }
    }
    set_normals(data, walkable, links);
    data.tree = std::move(tree);
    for (std::uint32_t& item : data.tree.order) item = walkable.number[item];
    data.leaf_of.resize(data.triangles.size());
    for (std::uint32_t i = 0; i < data.tree.leaves.size(); ++i) {
        const MeshLeaf& leaf = data.tree.leaves[i];
        for (std::uint32_t lane = 0; lane < leaf.count(); ++lane) data.leaf_of[data.tree.order[leaf.first + lane]] = i;
    }
}

LinkedTriangles disassemble(const WalkMeshData& data) {
    const std::vector<std::uint32_t> same = first_coincident(data.points);
    LinkedTriangles result;
    std::vector<std::uint32_t> place(data.triangles.size(), WalkLink::none);
    for (const Vec3& point : data.points) result.walkable.surface.points.push_back(point + Vec3(0.0f));
    for (std::uint32_t i = 0; i < data.triangles.size(); ++i) {
        if (!data.walk[i].is_walkable()) continue;
        const glm::uvec3& t = data.triangles[i];
        place[i] = static_cast<std::uint32_t>(result.walkable.number.size());
        result.walkable.number.push_back(i);
        result.walkable.surface.triangles.push_back({same[t.x], same[t.y], same[t.z]});
    }
    for (const std::uint32_t i : result.walkable.number) {
        std::array<WalkLink, 3>& links = result.links.of.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const WalkLink link = data.walk[i].link[k];
            if (!link.is_border()) links[k] = WalkLink::to(place[link.triangle()], link.side(), link.mirrored());
        }
    }
    result.links.non_manifold_edges = data.report.non_manifold_edges;
    result.links.mirrored = data.report.mirrored;
    result.links.border = data.report.border;
    return result;
}

}  // namespace abut::detail
