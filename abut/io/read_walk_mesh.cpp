#include <abut/io/file/glob.hpp>
#include <abut/io/file/read_file.hpp>
#include <abut/io/mesh/placed_meshes.hpp>
#include <abut/io/read_scene.hpp>
#include <abut/io/read_walk_mesh.hpp>
#include <abut/walk/file.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace abut {
namespace {

/// The file's name of a mesh: readers append a number for each primitive of a mesh of several primitives.
std::string_view mesh_name(const Geometry& geometry) {
    return std::string_view(geometry.name).substr(0, geometry.name.find(", primitive "));
}

/// All object names in the scene, for a message; at most 12 of them.
std::string names_in(const Scene& scene) {
    constexpr std::size_t max_listed = 12;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const SceneNode& node = scene.nodes[i];
        if (node.geometries.empty()) continue;
        const std::string mesh(mesh_name(scene.geometries[node.geometries.front()]));
        const bool same = mesh.empty() || mesh == node.name;
        names.push_back("'" + path(scene, i) + (same ? "'" : "' (mesh '" + mesh + "')"));
    }
    std::sort(names.begin(), names.end());
    std::string result;
    for (std::size_t i = 0; i < names.size() && i < max_listed; ++i) result += (i == 0 ? "" : ", ") + names[i];
    if (names.size() > max_listed) result += " and " + std::to_string(names.size() - max_listed) + " more";
    return result;
}

}  // namespace

Result<NamedWalkMesh> walk_mesh_of(const Scene& scene, std::string_view name) {
    bool is_found = name.empty();
    const auto filter = [&](std::size_t node, std::uint32_t geometry) {
        const bool is_match = name.empty() || detail::glob_matches(name, path(scene, node)) ||
                              detail::glob_matches(name, scene.nodes[node].name) ||
                              detail::glob_matches(name, mesh_name(scene.geometries[geometry]));
        is_found = is_found || is_match;
        return is_match;
    };
    Result<detail::PlacedMeshes> placed = detail::placed_meshes(scene, filter);
    if (!is_found)
        return Problem{ProblemCode::empty_input,
                       "nothing in it is named '" + std::string(name) + "'; there are " + names_in(scene)};
    if (!placed) return placed.problem();
    const Geometry merged = detail::merge_meshes(placed->objects, {});
    Result<WalkMesh> mesh = WalkMesh::build(merged.points, merged.triangles, merged.normals);
    if (!mesh) return mesh.problem();
    NamedWalkMesh result{*std::move(mesh), {}, std::move(placed->warnings)};
    for (Geometry& object : placed->objects) result.objects.push_back(std::move(object.name));
    return result;
}

Result<WalkMesh> read_walk_mesh(const std::filesystem::path& file, std::string_view name) {
    const Result<std::vector<std::byte>> bytes = detail::read_file(file);
    if (!bytes) return bytes.problem();
    if (is_walk_mesh(*bytes)) {
        if (!name.empty()) return Problem{ProblemCode::bad_argument, "a baked walk mesh has no names in it"};
        return load_walk_mesh(*bytes);
    }
    const Result<Scene> scene = read_scene(file, walk_mesh_options);
    if (!scene) return scene.problem();
    Result<NamedWalkMesh> result = walk_mesh_of(*scene, name);
    if (!result) return result.problem();
    return std::move(result->mesh);
}

}  // namespace abut
