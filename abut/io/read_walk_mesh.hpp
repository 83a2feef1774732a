#pragma once

// Walk meshes from files: made by hand in whatever the level was made in, or baked.

#include <abut/io/finish_scene.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// What an importer has to keep for walk meshes: triangles of zero area, which `WalkMesh::build` mends, and normals.
inline constexpr ReadOptions walk_mesh_options{.keep_degenerate = true, .normals = true};

/// Reads a walk mesh from a scene (whatever `read_scene` reads), or one that was baked (bytes that `save` made).
///
/// Of a scene it is all nodes' triangles where they stand at its first moment; with a `name` those of the nodes and
/// meshes alone that it describes, by path ("Level/Floor") or own name, with * for anything and ? for one character.
/// The vertices' normals are those of the walk mesh where all of its objects have some.
/// A Problem where the file can't be read, nothing has that name (it tells the names that there are), or `build`
/// refuses; its message doesn't name the file.
Result<WalkMesh> read_walk_mesh(const std::filesystem::path& file, std::string_view name = {});

struct NamedWalkMesh {
    WalkMesh mesh;
    std::vector<std::string> objects;  ///< the paths of the nodes it is made of, in order
    std::vector<std::string> warnings;
};

/// The same of a scene that is read, with `walk_mesh_options`.
Result<NamedWalkMesh> walk_mesh_of(const Scene& scene, std::string_view name = {});

}  // namespace abut
