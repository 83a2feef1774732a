#include "meshes.hpp"

#include "files.hpp"
#include <abut/io/write_mesh.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/vector_double4.hpp>
#include <glm/matrix.hpp>

namespace abut::tool {
namespace {

void add(Geometry& to, const Geometry& from) {
    const auto shift = static_cast<std::uint32_t>(to.points.size());
    to.points.insert(to.points.end(), from.points.begin(), from.points.end());
    for (const glm::uvec3& triangle : from.triangles) to.triangles.push_back(triangle + shift);
}

void place(Geometry& mesh, const glm::dmat4& matrix) {
    for (Vec3& point : mesh.points) point = Vec3(glm::dvec3(matrix * glm::dvec4(point, 1)));
    if (glm::determinant(glm::dmat3(matrix)) < 0)
        for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
}

bool is_point(const Geometry& mesh) {
    return std::all_of(mesh.points.begin(), mesh.points.end(), [&](const Vec3& p) { return p == mesh.points.front(); });
}

}  // namespace

Result<Meshes> load_meshes(const std::string& file) {
    if (dimension_of(file) == 2)
        return Problem{ProblemCode::bad_argument, file + ": is a level of the plane, and has no meshes"};
    Result<Scene> scene = load<3>(file, true);
    if (!scene) return scene.problem();
    Meshes result{{}, std::move(scene->warnings)};
    std::vector<glm::dmat4> matrices;
    world_matrices(*scene, key_times(*scene).front(), matrices);
    for (std::size_t i = 0; i < scene->nodes.size(); ++i) {
        if (scene->nodes[i].geometries.empty()) continue;
        Geometry object{path(*scene, i), {}, {}};
        for (const std::uint32_t geometry : scene->nodes[i].geometries) add(object, scene->geometries[geometry]);
        place(object, matrices[i]);
        const auto beyond = std::find_if(object.points.begin(), object.points.end(),
                                         [](const Vec3& point) { return !is_finite(point); });
        if (beyond != object.points.end())
            return Problem{ProblemCode::not_finite,
                           file + ": object '" + object.name + "': its transform takes it out of the range of floats"};
        if (is_point(object))
            result.warnings.push_back("object '" + object.name + "' is scaled to nothing, and left out");
        else
            result.objects.push_back(std::move(object));
    }
    if (result.objects.empty()) return Problem{ProblemCode::empty_input, file + ": all objects are scaled to nothing"};
    std::sort(result.objects.begin(), result.objects.end(),
              [](const Geometry& a, const Geometry& b) { return a.name < b.name; });
    return result;
}

Geometry together(std::span<const Geometry> meshes, std::string name) {
    Geometry result{std::move(name), {}, {}};
    for (const Geometry& mesh : meshes) add(result, mesh);
    return result;
}

std::string name_of(const std::string& file) {
    return std::filesystem::path(file).stem().string();
}

std::optional<Problem> check_output(const std::string& output, const std::string& input) {
    if (!can_write_meshes(output))
        return Problem{ProblemCode::bad_argument, output + ": doesn't end in .gltf, .glb or .obj"};
    std::error_code ignored;
    if (std::filesystem::equivalent(output, input, ignored))
        return Problem{ProblemCode::bad_argument, output + ": is the mesh itself, and would be overwritten"};
    return std::nullopt;
}

std::optional<Problem> write_output(const std::string& output, std::span<const Geometry> meshes) {
    std::optional<Problem> problem = write_meshes(output, meshes);
    if (problem) problem->message = output + ": " + problem->message;
    return problem;
}

}  // namespace abut::tool
