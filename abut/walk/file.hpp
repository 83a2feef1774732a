#pragma once

// Serialization of walk meshes: a pipeline saves them, a game loads them.

#include <abut/math/result.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

/// Serializes a mesh, with the same bytes on every machine, about 37 per triangle. `load_walk_mesh` restores it bit by
/// bit in less than half the time of `build`: the triangles are already cleaned up, oriented, linked and sorted into a
/// tree.
std::vector<std::byte> save(const WalkMesh& mesh);

/// Loads a mesh that `save` has written. A Problem (`bad_format`) if the bytes are too few or too many, have another
/// version or a wrong checksum, or contradict themselves; and the Problems of `build` for points, triangles or normals.
/// A file changed on purpose, with a valid checksum, may give another mesh but never an inconsistent one. The memory is
/// at most a few times the number of bytes.
Result<WalkMesh> load_walk_mesh(std::span<const std::byte> bytes);

/// True if the bytes begin with the signature of a walk mesh.
bool is_walk_mesh(std::span<const std::byte> bytes);

}  // namespace abut
