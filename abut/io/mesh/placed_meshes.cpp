#include <abut/io/mesh/placed_meshes.hpp>

#include <algorithm>
#include <utility>

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace abut::detail {
namespace {

void add(Geometry& to, const Geometry& from) {
    const auto offset = static_cast<std::uint32_t>(to.points.size());
    if (from.normals.size() != from.points.size() || to.normals.size() != to.points.size())
        to.normals.clear();
    else
        to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
    to.points.insert(to.points.end(), from.points.begin(), from.points.end());
    for (const glm::uvec3& triangle : from.triangles) to.triangles.push_back(triangle + offset);
}

/// Normals transform by the cofactor matrix: proportional to the inverse transpose, and defined for singular matrices
/// too.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
    const glm::dmat3 minors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::determinant(m) < 0 ? -minors : minors;
}

void transform(Geometry& mesh, const glm::dmat4& matrix) {
    for (Vec3& point : mesh.points) point = Vec3(glm::dvec3(matrix * glm::dvec4(point, 1)));
    const glm::dmat3 linear(matrix), for_normals = normal_matrix(linear);
    for (Vec3& normal : mesh.normals) {
        const glm::dvec3 transformed = for_normals * glm::dvec3(normal);
        const double norm = glm::length(transformed);
        normal = norm > 0 ? Vec3(transformed / norm) : Vec3(0.0f);
    }
    if (glm::determinant(linear) < 0)
        for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
}

bool is_point(const Geometry& mesh) {
    return std::all_of(mesh.points.begin(), mesh.points.end(), [&](const Vec3& p) { return p == mesh.points.front(); });
}

}  // namespace

Result<PlacedMeshes> placed_meshes(const Scene& scene, GeometryFilter filter) {
    PlacedMeshes result;
    std::vector<glm::dmat4> matrices;
    world_matrices(scene, key_times(scene).front(), matrices);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        Geometry object{path(scene, i), {}, {}};
        for (const std::uint32_t geometry : scene.nodes[i].geometries)
            if (filter(i, geometry)) add(object, scene.geometries[geometry]);
        if (object.triangles.empty()) continue;
        transform(object, matrices[i]);
        const auto invalid = std::find_if(object.points.begin(), object.points.end(),
                                          [](const Vec3& point) { return !is_finite(point); });
        if (invalid != object.points.end())
            return Problem{ProblemCode::not_finite,
                           "object '" + object.name + "': its transform takes it out of the range of floats"};
        if (is_point(object))
            result.warnings.push_back("object '" + object.name + "' is scaled to nothing, and left out");
        else
            result.objects.push_back(std::move(object));
    }
    if (result.objects.empty()) return Problem{ProblemCode::empty_input, "all objects are scaled to nothing"};
    std::stable_sort(result.objects.begin(), result.objects.end(),
                     [](const Geometry& a, const Geometry& b) { return a.name < b.name; });
    return result;
}

Result<PlacedMeshes> placed_meshes(const Scene& scene) {
    return placed_meshes(scene, [](std::size_t, std::uint32_t) { return true; });
}

Geometry merge_meshes(std::span<const Geometry> meshes, std::string name) {
    Geometry result{std::move(name), {}, {}};
    for (const Geometry& mesh : meshes) add(result, mesh);
    return result;
}

}  // namespace abut::detail
