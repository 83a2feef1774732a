#pragma once

// The tree behind a Mesh: nodes of eight children over leaves that hold their triangles' corners. Not for users.

#include <abut/broad_phase/bvh_node.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/large_pages.hpp>
#include <abut/math/ray.hpp>
#include <abut/shape/triangle.hpp>

#include <bit>
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
    std::uint32_t used;                  ///< as many bits as it has triangles
    /// Of the box around them, |x| + |y| + |z|, rounded up; infinite where floats can't multiply such numbers.
    float extent;

    std::uint32_t count() const { return static_cast<std::uint32_t>(std::popcount(used)); }
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

/// Products of three numbers as large have room in a float.
inline constexpr double mesh_most = 1e12;

struct MeshTree {
    std::vector<MeshNode, LargePages<MeshNode>> nodes;
    std::vector<MeshLeaf, LargePages<MeshLeaf>> leaves;
    /// The triangles of the input, as they follow one another in the leaves.
    std::vector<std::uint32_t, LargePages<std::uint32_t>> order;
    std::array<BvhRoot<3>, 2> roots;  ///< as a Bvh has them; the second of a mesh is empty
    DVec<3> middle{0.0};              ///< of the whole
    double off_center = 0;            ///< |x| + |y| + |z| of the middle
    /// |x| + |y| + |z| from there to its farthest corner; infinite where a coordinate is larger than floats multiply.
    double spread = 0;

    const BvhRoot<3>& root(std::size_t kind) const { return roots[kind]; }
    const MeshNode& node(std::uint32_t ref) const { return nodes[ref]; }
    const MeshLeaf& leaf(std::uint32_t ref) const { return leaves[ref & ~bvh_leaf_bit]; }
};

/// `same` names each point by the lowest one at its position. There is at least one triangle; all numbers are finite.
MeshTree build_mesh_tree(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                         std::span<const std::uint32_t> same);

/// The triangles whose boxes overlap the box.
void find_overlapping(const MeshTree& tree, const Aabb3& box, ItemCall visit);
/// The triangles whose boxes are within reach of a ray, a moving box or a box; of two nodes, the nearer first.
void find_within(const MeshTree& tree, const RayReach<3>& reach, ReachCall visit);
void find_within(const MeshTree& tree, const BoxReach<3>& reach, ReachCall visit);

}  // namespace abut
