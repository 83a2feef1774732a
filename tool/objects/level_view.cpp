#include "tool/objects/level_view.hpp"

#include "tool/objects/flat_surface.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace abut::tool {
namespace {

Surface<3> surface_in_place(const Welded& surface, const glm::dmat4& matrix) {
    Surface<3> result;
    result.points.reserve(surface.points.size());
    for (const Vec3& p : surface.points) result.points.emplace_back(matrix * glm::dvec4(glm::dvec3(p), 1.0));
    result.facets.reserve(surface.triangles.size());
    const bool mirrored = glm::determinant(glm::dmat3(matrix)) < 0;
    for (const glm::uvec3& t : surface.triangles)
        result.facets.push_back(mirrored ? Surface<3>::Facet{t.x, t.z, t.y} : Surface<3>::Facet{t.x, t.y, t.z});
    return result;
}

template <int D>
ViewedObject<D> viewed(const Object<D>& object) {
    ViewedObject<D> result;
    result.path = object.path;
    result.name = object.name;
    result.type = object.type;
    result.shape = object.placed;
    result.box = object.box;
    result.radius = object.radius;
    result.convex = object.solid;
    result.filled = object.solid || object.filled;
    return result;
}

template <int D>
void sort_places(LevelView<D>& level) {
    std::stable_sort(level.places.begin(), level.places.end(),
                     [](const NamedPlace<D>& a, const NamedPlace<D>& b) { return a.path < b.path; });
}

}  // namespace

LevelView<3> level_view(const Scene& scene, const SceneObjects& objects, double time) {
    LevelView<3> result;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        if (!objects[i].present) continue;
        ViewedObject<3>& object = result.objects.emplace_back(viewed(objects[i]));
        object.model = objects.model(i);
        object.surface = surface_in_place(objects.surface(i), objects.matrix(i));
    }
    std::vector<glm::dmat4> matrices;
    world_matrices(scene, time, matrices);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (!scene.nodes[i].name.empty())
            result.places.push_back({path(scene, i), scene.nodes[i].name, Vec3(matrices[i][3]), {}});
    sort_places(result);
    return result;
}

LevelView<2> level_view(const Level& level, const LevelObjects& objects, double) {
    LevelView<2> result;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        ViewedObject<2>& object = result.objects.emplace_back(viewed(objects[i]));
        const LevelShape& shape = objects.source(i).shape;
        object.model = i;
        // Tiles and the parts of a compound are solid.
        object.filled =
            object.filled || std::holds_alternative<TileMap>(shape) || std::holds_alternative<Compound2>(shape);
        Result<Surface<2>> surface = surface_of(object.shape, object.filled, std::get_if<TileMap>(&shape));
        if (surface)
            object.surface = *std::move(surface);
        else if (!result.problem)
            result.problem =
                Problem{surface.problem().code, "object '" + object.path + "': " + surface.problem().message};
    }
    std::set<std::string_view> solid;
    for (const ViewedObject<2>& object : result.objects) solid.insert(object.path);
    for (const LevelObject& object : level.objects) {
        const Aabb2 box = bounds(object);
        NamedPlace<2>& place = result.places.emplace_back();
        place = {object.path, object.name, center(box), object.type};
        if (!solid.contains(object.path)) place.area = box;
    }
    for (const LevelPoint& point : level.points)
        result.places.push_back({point.path, point.name, point.position, point.type});
    sort_places(result);
    return result;
}

}  // namespace abut::tool
