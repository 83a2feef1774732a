#pragma once

// The objects of a scene as triangle meshes in world space.

#include <abut/io/scene.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut::detail {

struct PlacedMeshes {
    std::vector<Geometry> objects;  ///< named by their paths and sorted by them; at least one
    std::vector<std::string> warnings;
};

/// True if a node's geometry is included, by their indices.
using GeometryFilter = FunctionRef<bool(std::size_t node, std::uint32_t geometry)>;

/// Transforms all geometry to world space at the scene's first time, one mesh per node. Triangles of mirrored nodes are
/// reversed, so that their front faces stay outside. Objects that are scaled to a point are left out with a warning.
/// Returns a Problem if a transform moves an object out of the range of floats, or no object is left.
Result<PlacedMeshes> placed_meshes(const Scene& scene, GeometryFilter takes);
Result<PlacedMeshes> placed_meshes(const Scene& scene);

/// Merges meshes to one; it has normals if all of them have normals.
Geometry merge_meshes(std::span<const Geometry> meshes, std::string name);

}  // namespace abut::detail
