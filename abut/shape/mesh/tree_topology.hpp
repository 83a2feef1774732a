#pragma once

// The topology of a mesh's tree: enough to rebuild it bit for bit without a search for splits.

#include <abut/shape/mesh/tree.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// The grouping of triangles into leaves and nodes. Memory: about 7 bytes a triangle.
struct MeshTreeTopology {
    std::vector<std::uint32_t> order;     ///< the tree's order
    std::vector<std::uint16_t> corners;   ///< corner indices of each triangle in that order, as in MeshLeaf
    std::vector<std::uint8_t> counts;     ///< number of triangles of each leaf
    std::vector<std::uint32_t> children;  ///< eight references a node, as in MeshNode
};

MeshTreeTopology topology_of(const MeshTree& tree);

/// Rebuilds the tree of welded triangles from its topology. Any input gives a valid tree of limited depth, or nothing.
std::optional<MeshTree> build_mesh_tree(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                        const MeshTreeTopology& topology);

}  // namespace abut::detail
