#pragma once

// Which triangles of a mesh share their edges. Not for users.

#include <abut/shape/neighbour.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

struct MeshAdjacency {
    /// By triangle: who shares the edge from corner i to the next, whichever way round it has it.
    std::vector<std::array<std::uint32_t, 3>> neighbours;
    /// Each edge is had equally often both ways.
    bool closed = false;
};

/// `same` names each point by the lowest one at its position. O(n log k) for k triangles about a point.
MeshAdjacency build_mesh_adjacency(std::span<const glm::uvec3> triangles, std::span<const std::uint32_t> same);

}  // namespace abut
