#include <abut/math/dvec.hpp>
#include <abut/math/union_find.hpp>
#include <abut/shape/mesh/surface.hpp>

namespace abut::detail {

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
