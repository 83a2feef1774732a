#pragma once

// Walk meshes as bytes: what a pipeline bakes and a game loads.

#include <abut/math/result.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

/// The mesh as bytes, the same on every machine, about 37 a triangle. `load_walk_mesh` makes the same mesh of them, bit
/// by bit, in less than half of the time that `build` takes: triangles are tidy, turned, linked and in a tree already.
std::vector<std::byte> save(const WalkMesh& mesh);

/// A Problem where they aren't what `save` makes of a walk mesh (`bad_format`: they end too soon, go on, are of another
/// version, a bit is wrong, or what they say of the surface can't be), or where `build` would refuse the points,
/// triangles or normals. Who changes a blob and sets its checksum right may get another mesh, never one that isn't
/// sound. Takes no more memory than a few times the bytes.
Result<WalkMesh> load_walk_mesh(std::span<const std::byte> bytes);

/// Whether the bytes begin as those of a walk mesh do.
bool is_walk_mesh(std::span<const std::byte> bytes);

}  // namespace abut
