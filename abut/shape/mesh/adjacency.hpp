#pragma once

// Edge adjacency of the triangles of a mesh. Not for users.

#include <abut/math/detail/large_pages.hpp>
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

}  // namespace abut::detail
