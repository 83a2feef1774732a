#pragma once

// Reads walk meshes from files: authored in a modelling tool, or baked.

#include <abut/io/mesh/finish_scene.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// Options for reading a scene that becomes a walk mesh: keep normals, and triangles of zero area, which
/// `WalkMesh::build` repairs.
inline constexpr ReadOptions walk_mesh_options{.keep_degenerate = true, .normals = true};

/// Reads a walk mesh from a scene (any format of `read_scene`) or from a baked file (bytes that `save` returned).
/// A scene contributes the triangles of all nodes, placed at its first time. With a `name`, only nodes and meshes that
/// match the glob pattern by path ("Level/Floor") or own name contribute. The walk mesh has the vertex normals of the
/// file if all of its objects have some. Returns a Problem if the file can't be read, nothing matches the name (the
/// message lists the names), or `WalkMesh::build` fails. The message doesn't name the file.
Result<WalkMesh> read_walk_mesh(const std::filesystem::path& file, std::string_view name = {});

struct NamedWalkMesh {
    WalkMesh mesh;
    std::vector<std::string> objects;  ///< sorted paths of the nodes it consists of
    std::vector<std::string> warnings;
};

/// Builds a walk mesh of a scene that was read with `walk_mesh_options`. See `read_walk_mesh`.
Result<NamedWalkMesh> walk_mesh_of(const Scene& scene, std::string_view name = {});

}  // namespace abut
