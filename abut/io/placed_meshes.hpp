#pragma once

// The objects of a scene as triangles in the world.

#include <abut/io/scene.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

struct PlacedMeshes {
    std::vector<Geometry> objects;  ///< named by their paths, in the order of these; at least one
    std::vector<std::string> warnings;
};

/// Whether a geometry of a node is taken, by their numbers.
using TakesGeometry = FunctionRef<bool(std::size_t node, std::uint32_t geometry)>;

/// Where they stand at the scene's first moment, those of each node as one. Triangles of nodes that are mirrored are
/// turned, so that what was outside stays so. Objects that are scaled to nothing are left out with a warning. A Problem
/// where a transform takes one out of the range of floats, or nothing is left.
Result<PlacedMeshes> placed_meshes(const Scene& scene, TakesGeometry takes);
Result<PlacedMeshes> placed_meshes(const Scene& scene);

/// All triangles as one mesh; with normals where all have them.
Geometry together(std::span<const Geometry> meshes, std::string name);

}  // namespace abut
