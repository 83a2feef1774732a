#include <abut/io/file_bytes.hpp>
#include <abut/io/glob.hpp>
#include <abut/io/placed_meshes.hpp>
#include <abut/io/read_scene.hpp>
#include <abut/io/read_walk_mesh.hpp>
#include <abut/walk/walk_blob.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace abut {
namespace {

/// Of a mesh of several parts each is a geometry, with its number behind the name.
std::string_view mesh_name(const Geometry& geometry) {
    return std::string_view(geometry.name).substr(0, geometry.name.find(", primitive "));
}

/// The names of what a walk mesh could be made of, for a message.
std::string names_in(const Scene& scene) {
    constexpr std::size_t most = 12;
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
    for (std::size_t i = 0; i < names.size() && i < most; ++i) result += (i == 0 ? "" : ", ") + names[i];
    if (names.size() > most) result += " and " + std::to_string(names.size() - most) + " more";
    return result;
}

}  // namespace

Result<NamedWalkMesh> walk_mesh_of(const Scene& scene, std::string_view name) {
    bool is_there = name.empty();
    const auto takes = [&](std::size_t node, std::uint32_t geometry) {
        const bool taken = name.empty() || matches(name, path(scene, node)) || matches(name, scene.nodes[node].name) ||
                           matches(name, mesh_name(scene.geometries[geometry]));
        is_there = is_there || taken;
        return taken;
    };
    Result<PlacedMeshes> placed = placed_meshes(scene, takes);
    if (!is_there)
        return Problem{ProblemCode::empty_input,
                       "nothing in it is named '" + std::string(name) + "'; there are " + names_in(scene)};
    if (!placed) return placed.problem();
    const Geometry whole = together(placed->objects, {});
    Result<WalkMesh> mesh = WalkMesh::build(whole.points, whole.triangles, whole.normals);
    if (!mesh) return mesh.problem();
    NamedWalkMesh result{*std::move(mesh), {}, std::move(placed->warnings)};
    for (Geometry& object : placed->objects) result.objects.push_back(std::move(object.name));
    return result;
}

Result<WalkMesh> read_walk_mesh(const std::filesystem::path& file, std::string_view name) {
    const Result<std::vector<std::byte>> bytes = file_bytes(file);
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
