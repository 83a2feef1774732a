#pragma once

// All data of a mesh. Not for users.

#include <abut/shape/mesh/adjacency.hpp>
#include <abut/shape/mesh/tree.hpp>

#include <cstdint>
#include <vector>

namespace abut::detail {

struct MeshSurface {
    std::vector<Vec3, LargePages<Vec3>> points;
    std::vector<glm::uvec3, LargePages<glm::uvec3>> triangles;
    MeshTree tree;
    MeshAdjacency adjacency;

    // Of a closed mesh, for queries that treat it as solid:
    std::vector<std::uint32_t> components;  ///< one triangle of each component that is connected across manifold edges
    bool inward = false;                    ///< the surface as a whole encloses a negative volume
};

/// Sets `components` and `inward`. O(n).
void find_components(MeshSurface& surface);

}  // namespace abut::detail
