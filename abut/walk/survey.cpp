#include <abut/math/dvec.hpp>
#include <abut/shape/mesh/half_edges.hpp>
#include <abut/walk/build/assemble.hpp>
#include <abut/walk/build/vertex_fans.hpp>
#include <abut/walk/frame.hpp>
#include <abut/walk/survey.hpp>

#include <algorithm>
#include <utility>

namespace abut {

using namespace detail;

namespace {

double length_of(const WalkEdge& edge) {
    return length(DVec<3>(edge.to) - DVec<3>(edge.from));
}

std::vector<WalkComponent> components_of(const WalkMeshData& data) {
    std::vector<WalkComponent> result(data.report.components);
    std::vector<double> largest(result.size(), -1);
    const Vec3 middle = quantised_weights(1.0 / 3, 1.0 / 3);
    for (std::uint32_t i = 0; i < data.walk.size(); ++i) {
        const WalkTriangle& walk = data.walk[i];
        if (!walk.is_walkable()) continue;
        WalkComponent& component = result[data.components[i]];
        const DVec<3> first(walk.corner[0]);
        const double area = 0.5 * length(cross(DVec<3>(walk.corner[1]) - first, DVec<3>(walk.corner[2]) - first));
        ++component.triangles;
        component.area += area;
        for (const Vec3& corner : walk.corner) component.box = merged(component.box, Aabb3{corner, corner});
        double& largest_area = largest[data.components[i]];
        if (area <= largest_area) continue;
        largest_area = area;
        component.place = {i, middle};
    }
    return result;
}

/// A border side. If `backwards`, it is traversed from corner k + 1 to corner k.
struct BorderSide {
    std::uint32_t triangle = 0, side = 0;
    bool backwards = false;

    std::uint32_t start() const { return backwards ? next_corner(side) : side; }
    std::uint32_t end() const { return backwards ? side : next_corner(side); }
};

/// The next side of the border, found by walking through the triangles around the end's corner.
BorderSide next_border(const WalkMeshData& data, const BorderSide& from) {
    std::uint32_t triangle = from.triangle, corner = from.end(), arrived = from.side;
    for (std::size_t turns = 0; turns < data.walk.size(); ++turns) {
        // Two sides share the corner: the one with its number starts there, the previous one ends there.
        const std::uint32_t before = next_corner(next_corner(corner));
        const std::uint32_t leaves = arrived == corner ? before : corner;
        const WalkLink link = data.walk[triangle].link[leaves];
        if (link.is_border()) return {triangle, leaves, leaves == before};
        const bool starts_there = (leaves == corner) == link.mirrored();
        triangle = link.triangle();
        arrived = link.side();
        corner = starts_there ? arrived : next_corner(arrived);
    }
    return from;
}

std::vector<WalkBorder> borders_of(const WalkMeshData& data) {
    std::vector<WalkBorder> result;
    std::vector<bool> visited(3 * data.walk.size(), false);
    for (std::uint32_t i = 0; i < visited.size(); ++i) {
        const WalkTriangle& first = data.walk[i / 3];
        if (visited[i] || !first.is_walkable() || !first.link[i % 3].is_border()) continue;
        WalkBorder border;
        border.component = data.components[i / 3];
        for (BorderSide at{i / 3, i % 3}; !visited[3 * at.triangle + at.side]; at = next_border(data, at)) {
            visited[3 * at.triangle + at.side] = true;
            const WalkTriangle& walk = data.walk[at.triangle];
            border.points.push_back(walk.corner[at.start()]);
            border.length += length_of({walk.corner[at.start()], walk.corner[at.end()]});
        }
        result.push_back(std::move(border));
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const WalkBorder& a, const WalkBorder& b) { return a.component < b.component; });
    std::vector<WalkBorder*> longest(data.report.components, nullptr);
    for (WalkBorder& border : result) {
        WalkBorder*& border_of_component = longest[border.component];
        if (border_of_component == nullptr || border.length > border_of_component->length)
            border_of_component = &border;
    }
    for (WalkBorder* border_of_component : longest)
        if (border_of_component != nullptr) border_of_component->is_rim = true;
    return result;
}

std::vector<WalkEdge> find_non_manifold_edges(const Welded& surface) {
    std::vector<std::pair<std::uint32_t, WalkEdge>> found;
    const std::vector<HalfEdge> sorted = sorted_half_edges(surface.triangles);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        if (edge.size() > 2)
            found.push_back({edge[0].side, {surface.points[edge[0].low], surface.points[edge[0].high]}});
    });
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<WalkEdge> result;
    for (const auto& [side, edge] : found) result.push_back(edge);
    return result;
}

std::vector<WalkEdge> mirrored_edges(const WalkMeshData& data) {
    std::vector<WalkEdge> result;
    for (std::uint32_t i = 0; i < data.walk.size(); ++i) {
        const WalkTriangle& walk = data.walk[i];
        for (std::uint32_t k = 0; k < 3; ++k)
            if (!walk.link[k].is_border() && walk.link[k].mirrored() && i < walk.link[k].triangle())
                result.push_back({walk.corner[k], walk.corner[next_corner(k)]});
    }
    return result;
}

}  // namespace

WalkSurvey survey(const WalkMesh& mesh) {
    const WalkMeshData& data = mesh.data();
    const LinkedTriangles linked = disassemble(data);
    WalkSurvey result{components_of(data),
                      borders_of(data),
                      {},
                      find_non_manifold_edges(linked.walkable.surface),
                      mirrored_edges(data)};
    for (const std::uint32_t point : non_manifold_vertices(linked.walkable.surface.triangles, linked.links))
        result.non_manifold_vertices.push_back(linked.walkable.surface.points[point]);
    return result;
}

}  // namespace abut
