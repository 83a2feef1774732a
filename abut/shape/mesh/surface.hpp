#pragma once

// All data of a mesh. Not for users.

#include <abut/shape/mesh/adjacency.hpp>
#include <abut/shape/mesh/tree.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

struct MeshSurface {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    MeshTree tree;
    MeshAdjacency adjacency;

    // Of a closed mesh, for queries that treat it as solid:
    std::vector<std::uint32_t> components;  ///< one point of each connected component of the surface
    bool inward = false;                    ///< the surface as a whole encloses a negative volume
};

/// Sets `components` and `inward`. `same` maps each point to the lowest index at its position. O(n).
void find_components(MeshSurface& surface, std::span<const std::uint32_t> same);

}  // namespace abut::detail
