#pragma once

// All data of a mesh. Not for users.

#include <abut/math/detail/large_pages.hpp>
#include <abut/shape/mesh/tree.hpp>
#include <abut/shape/view/parts.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

struct MeshAdjacency {
    /// For each triangle, the triangle across the edge from corner i to the next, in either direction.
    std::vector<std::array<std::uint32_t, 3>, LargePages<std::array<std::uint32_t, 3>>> neighbours;
    /// True if the mesh is watertight: each edge occurs equally often in both directions.
    bool closed = false;
};

/// `same` maps each point to the lowest index at its position. O(n log k) for k triangles around a point.
MeshAdjacency build_mesh_adjacency(std::span<const glm::uvec3> triangles, std::span<const std::uint32_t> same);

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
