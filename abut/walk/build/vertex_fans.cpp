#include <abut/math/detail/no_index.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/union_find.hpp>
#include <abut/walk/build/vertex_fans.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace abut::detail {
namespace {

/// Unites the corners 3t, 3t + 1 and 3t + 2 of each triangle t across edges, by union-find.
UnionFind vertex_fans(std::span<const glm::uvec3> triangles, const WalkLinks& links, bool over_mirrored) {
    UnionFind result(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::uint32_t side = 0; side < 3; ++side) {
            const WalkLink link = links.of[t][side];
            if (link.is_border() || link.triangle() < t || (link.mirrored() && !over_mirrored)) continue;
            // The corner at the side's start corresponds to the start of the neighbour's side only if mirrored.
            const std::uint32_t start = link.mirrored() ? link.side() : next_corner(link.side());
            const std::uint32_t end = link.mirrored() ? next_corner(link.side()) : link.side();
            result.unite(3 * t + side, 3 * link.triangle() + start);
            result.unite(3 * t + next_corner(side), 3 * link.triangle() + end);
        }
    return result;
}

}  // namespace

std::vector<std::uint32_t> non_manifold_vertices(std::span<const glm::uvec3> triangles, const WalkLinks& links) {
    UnionFind groups = vertex_fans(triangles, links, true);
    std::uint32_t points = 0;
    for (const glm::uvec3& t : triangles) points = std::max({points, t.x + 1, t.y + 1, t.z + 1});
    std::vector<std::uint8_t> at(points, 0);
    for (std::uint32_t corner = 0; corner < 3 * triangles.size(); ++corner) {
        if (groups.find(corner) != corner) continue;
        std::uint8_t& count = at[triangles[corner / 3][static_cast<glm::length_t>(corner % 3)]];
        if (count < 2) ++count;
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < points; ++i)
        if (at[i] == 2) result.push_back(i);
    return result;
}

WalkNormals fan_normals(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, const WalkLinks& links) {
    UnionFind groups = vertex_fans(triangles, links, false);
    std::vector<std::uint32_t> number(3 * triangles.size(), no_index);
    std::vector<DVec<3>> sums;
    WalkNormals result;
    result.of.resize(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const DVec<3> corner[3] = {DVec<3>(points[triangles[t].x]), DVec<3>(points[triangles[t].y]),
                                   DVec<3>(points[triangles[t].z])};
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::size_t fan = groups.find(3 * t + k);
            if (number[fan] == no_index) {
                number[fan] = static_cast<std::uint32_t>(sums.size());
                sums.push_back(DVec<3>(0.0));
            }
            const std::uint32_t j = next_corner(k);
            const DVec<3> next = corner[j] - corner[k], last = corner[next_corner(j)] - corner[k];
            sums[number[fan]] += cross(next, last) / (length_squared(next) * length_squared(last));
            result.of[t][static_cast<glm::length_t>(k)] = number[fan];
        }
    }
    for (const DVec<3>& sum : sums) result.normals.push_back(to_float(normalized(sum, DVec<3>(0.0))));
    return result;
}

}  // namespace abut::detail
