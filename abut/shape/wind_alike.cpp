#include <abut/math/dvec.hpp>
#include <abut/shape/half_edges.hpp>
#include <abut/shape/wind_alike.hpp>

#include <span>
#include <utility>

namespace abut {
namespace {

constexpr std::uint32_t none = AcrossEdge::none;

void turn(glm::uvec3& triangle) {
    std::swap(triangle.y, triangle.z);
}

double area_of(const Welded& surface, const glm::uvec3& t) {
    const DVec<3> a(surface.points[t.x]), b(surface.points[t.y]), c(surface.points[t.z]);
    return length(cross(b - a, c - a));
}

std::vector<AcrossEdge> across_pairs(std::span<const glm::uvec3> triangles) {
    std::vector<AcrossEdge> result(3 * triangles.size());
    const std::vector<HalfEdge> sorted = sorted_half_edges(triangles);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        if (edge.size() != 2) return;
        const bool agrees = edge[0].upwards != edge[1].upwards;
        result[edge[0].side] = {edge[1].side / 3, agrees};
        result[edge[1].side] = {edge[0].side / 3, agrees};
    });
    return result;
}

}  // namespace

Patches wind_alike(Welded& surface) {
    return wind_alike(surface, across_pairs(surface.triangles));
}

Patches wind_alike(Welded& surface, std::span<const AcrossEdge> across) {
    std::vector<glm::uvec3>& triangles = surface.triangles;
    Patches patches{std::vector<std::uint32_t>(triangles.size(), none), {}};
    std::vector<bool> turned(triangles.size(), false);
    std::vector<std::uint32_t> members;
    for (std::uint32_t first = 0; first < triangles.size(); ++first) {
        if (patches.of[first] != none) continue;
        const auto patch = static_cast<std::uint32_t>(patches.count());
        patches.agreed.push_back(true);
        patches.of[first] = patch;
        members.assign(1, first);
        double turned_area = 0, kept_area = 0;
        for (std::size_t next = 0; next < members.size(); ++next) {
            const std::uint32_t triangle = members[next];
            (turned[triangle] ? turned_area : kept_area) += area_of(surface, triangles[triangle]);
            for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
                const auto& [neighbour, agrees] = across[side];
                if (neighbour == none) continue;
                if (!agrees) patches.agreed[patch] = false;
                if (patches.of[neighbour] != none) continue;
                patches.of[neighbour] = patch;
                turned[neighbour] = turned[triangle] == agrees;
                members.push_back(neighbour);
            }
        }
        const bool turns = turned_area <= kept_area;
        for (const std::uint32_t triangle : members)
            if (turned[triangle] == turns) turn(triangles[triangle]);
    }
    return patches;
}

}  // namespace abut
