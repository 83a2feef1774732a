#pragma once

// Writes meshes as glTF 2.0.

#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// Returns a self-contained .gltf: one scene with one root node per mesh, in order and with the same names, and one
/// buffer in base64. Triangles have 32-bit indices and no normals, so that viewers shade them flat. Coordinates are
/// unchanged; glTF defines them as metres with y up. Invalid UTF-8 in names is replaced. Returns a Problem for meshes
/// that can't be written (see `detail::problem_of`) and for more than 2 GiB of data (`too_large`).
Result<std::string> write_gltf(std::span<const Geometry> meshes);

/// Returns a .glb with the buffer in binary: about 25 % smaller than `write_gltf`.
Result<std::vector<std::byte>> write_glb(std::span<const Geometry> meshes);

}  // namespace abut
