#include <abut/math/dvec.hpp>
#include <abut/shape/mesh/half_edges.hpp>
#include <abut/shape/mesh/orient.hpp>

#include <span>
#include <utility>

namespace abut::detail {
namespace {

void flip(glm::uvec3& triangle) {
    std::swap(triangle.y, triangle.z);
}

double area_of(const Welded& surface, const glm::uvec3& t) {
    const DVec<3> a(surface.points[t.x]), b(surface.points[t.y]), c(surface.points[t.z]);
    return length(cross(b - a, c - a));
}

std::vector<AdjacentTriangle> adjacent_across_manifold_edges(std::span<const glm::uvec3> triangles) {
    std::vector<AdjacentTriangle> result(3 * triangles.size());
    const std::vector<HalfEdge> sorted = sorted_half_edges(triangles);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        if (edge.size() != 2) return;
        const bool consistent = edge[0].upwards != edge[1].upwards;
        result[edge[0].side] = {edge[1].side / 3, consistent};
        result[edge[1].side] = {edge[0].side / 3, consistent};
    });
    return result;
}

}  // namespace

Patches orient_consistently(Welded& surface) {
    return orient_consistently(surface, adjacent_across_manifold_edges(surface.triangles));
}

Patches orient_consistently(Welded& surface, std::span<const AdjacentTriangle> across) {
    std::vector<glm::uvec3>& triangles = surface.triangles;
    Patches patches{std::vector<std::uint32_t>(triangles.size(), no_index), {}};
    std::vector<bool> flipped(triangles.size(), false);
    std::vector<std::uint32_t> members;
    for (std::uint32_t first = 0; first < triangles.size(); ++first) {
        if (patches.of[first] != no_index) continue;
        const auto patch = static_cast<std::uint32_t>(patches.count());
        patches.was_consistent.push_back(true);
        patches.of[first] = patch;
        members.assign(1, first);
        double flipped_area = 0, unflipped_area = 0;
        for (std::size_t next = 0; next < members.size(); ++next) {
            const std::uint32_t triangle = members[next];
            (flipped[triangle] ? flipped_area : unflipped_area) += area_of(surface, triangles[triangle]);
            for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
                const auto& [neighbour, consistent] = across[side];
                if (neighbour == no_index) continue;
                if (!consistent) patches.was_consistent[patch] = false;
                if (patches.of[neighbour] != no_index) continue;
                patches.of[neighbour] = patch;
                flipped[neighbour] = flipped[triangle] == consistent;
                members.push_back(neighbour);
            }
        }
        const bool flips = flipped_area <= unflipped_area;
        for (const std::uint32_t triangle : members)
            if (flipped[triangle] == flips) flip(triangles[triangle]);
    }
    return patches;
}

}  // namespace abut::detail
