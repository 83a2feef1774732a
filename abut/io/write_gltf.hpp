#pragma once

// Meshes as glTF 2.0.

#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// A .gltf that needs no other file: one node a mesh, in their order and of their names, at the root of the one scene;
/// all numbers in one buffer, in base64. Triangles have 32-bit indices and no normals, so that viewers show them flat.
/// Coordinates stay as they are, which glTF takes for metres with y up. Names that aren't UTF-8 have what isn't
/// replaced. A Problem for meshes that can't be written (see `problem_of`), and for more than 2 GiB
/// of them (`too_large`).
Result<std::string> write_gltf(std::span<const Geometry> meshes);

/// The same as a .glb, with the buffer as it is: a quarter smaller.
Result<std::vector<std::byte>> write_glb(std::span<const Geometry> meshes);

}  // namespace abut
