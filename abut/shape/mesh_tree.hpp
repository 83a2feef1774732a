#pragma once

// The tree behind a Mesh: nodes of eight children over leaves that hold their triangles' corners. Not for users.

#include <abut/broad_phase/bvh_node.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/large_pages.hpp>
#include <abut/math/ray.hpp>
#include <abut/shape/triangle.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

inline constexpr std::uint32_t mesh_lanes = bvh_lanes;

/// Up to eight triangles, by increasing index, that have up to eight corners together: neighbours share them, so that
/// a triangle takes about as much room as three of its nine numbers would by themselves.
struct alignas(64) MeshLeaf {
    float corner[3][mesh_lanes];         ///< positions by axis; unused ones repeat another
    std::uint16_t triangle[mesh_lanes];  ///< the numbers of its corners, three bits each, the first lowest
    std::uint32_t first;                 ///< of its triangles in the tree's order; the others follow
    std::uint32_t count;
    float extent;  ///< of its triangles' edges from their first corners: the largest |x| + |y| + |z|, rounded up

    Vec3 position(std::uint32_t number) const { return {corner[0][number], corner[1][number], corner[2][number]}; }
    Triangle3 at(std::uint32_t lane) const {
        const std::uint32_t numbers = triangle[lane];
        return {position(numbers & 7u), position(numbers >> 3 & 7u), position(numbers >> 6 & 7u)};
    }
};

/// Its boxes are a little wider than what is in them.
struct alignas(32) MeshNode : BvhRows<3> {
    std::uint32_t child[mesh_lanes];  ///< bvh_none where unused
};

static_assert(sizeof(MeshLeaf) == 128 && sizeof(MeshNode) == 224);

struct MeshTree {
    std::vector<MeshNode, LargePages<MeshNode>> nodes;
    std::vector<MeshLeaf, LargePages<MeshLeaf>> leaves;
    std::vector<std::uint32_t> order;  ///< the triangles of the input, as they follow one another in the leaves
    std::array<BvhRoot<3>, 2> roots;   ///< as a Bvh has them; the second of a mesh is empty

    const BvhRoot<3>& root(std::size_t kind) const { return roots[kind]; }
    const MeshNode& node(std::uint32_t ref) const { return nodes[ref]; }
    const MeshLeaf& leaf(std::uint32_t ref) const { return leaves[ref & ~bvh_leaf_bit]; }
};

/// `same` names each point by the lowest one at its position. There is at least one triangle; all numbers are finite.
MeshTree build_mesh_tree(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                         std::span<const std::uint32_t> same);

using MeshReachCall = FunctionRef<float(const Triangle3& triangle, const std::uint32_t& index)>;

/// The triangles whose boxes overlap the box.
void find_overlapping(const MeshTree& tree, const Aabb3& box, ItemCall visit);
/// The triangles whose boxes are within reach of a ray, a moving box or a box; of two nodes, the nearer first.
void find_within(const MeshTree& tree, const RayReach<3>& reach, ReachCall visit);
void find_within(const MeshTree& tree, const BoxReach<3>& reach, ReachCall visit);

/// At least the triangles that the way of a point meets within reach, where the point may be anywhere in a small box,
/// and few others; of two nodes, the nearer first. False, and nothing was visited, where floats can't hold the numbers.
bool find_on_line(const MeshTree& tree, const MovingBox<3>& point, MeshReachCall visit);

}  // namespace abut
