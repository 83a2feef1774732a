#include <abut/math/dvec.hpp>
#include <abut/math/union_find.hpp>
#include <abut/shape/mesh/surface.hpp>

namespace abut::detail {

void find_components(MeshSurface& surface, std::span<const std::uint32_t> same) {
    UnionFind sets(surface.points.size());
    double volume = 0;
    const DVec<3> origin(surface.points[surface.triangles[0].x]);
    for (const glm::uvec3& t : surface.triangles) {
        sets.unite(same[t.x], same[t.y]);
        sets.unite(same[t.x], same[t.z]);
        const DVec<3> a(surface.points[t.x]), b(surface.points[t.y]), c(surface.points[t.z]);
        volume += dot(cross(a - origin, b - origin), c - origin);
    }
    surface.inward = volume < 0;
    std::vector<bool> is_known(surface.points.size());
    for (const glm::uvec3& t : surface.triangles) {
        const std::size_t set = sets.find(same[t.x]);
        if (is_known[set]) continue;
        is_known[set] = true;
        surface.components.push_back(t.x);
    }
}

}  // namespace abut::detail
