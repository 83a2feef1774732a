#pragma once

// How a mesh's tree parts its triangles: enough to make it again, bit by bit, without looking for where to split.

#include <abut/shape/mesh_tree.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// About 7 bytes a triangle.
struct MeshTreePlan {
    std::vector<std::uint32_t> order;     ///< as the tree has it
    std::vector<std::uint16_t> corners;   ///< of each in that order, the numbers of its corners as MeshLeaf has them
    std::vector<std::uint8_t> counts;     ///< of triangles, by leaf
    std::vector<std::uint32_t> children;  ///< eight a node, as MeshNode has them
};

MeshTreePlan plan_of(const MeshTree& tree);

/// The tree that the plan was made of, of the same triangles; points are welded. Nothing where there is none: of any
/// plan comes a tree that is right and not too deep, or nothing.
std::optional<MeshTree> build_mesh_tree(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                        const MeshTreePlan& plan);

}  // namespace abut
