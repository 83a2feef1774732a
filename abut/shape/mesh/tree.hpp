#pragma once

// The bounding volume hierarchy (BVH) of a Mesh: nodes of eight children over leaves that hold the corners of up to
// eight triangles. Not for users.

#include <abut/broad_phase/bvh/node.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/detail/large_pages.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/ray.hpp>
#include <abut/shape/triangle.hpp>

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

inline constexpr std::uint32_t mesh_lanes = bvh_lanes;

/// Up to eight triangles, in ascending order, that share up to eight vertices. Sharing reduces a triangle to about
/// three of its nine floats.
struct alignas(64) MeshLeaf {
    float corner[3][mesh_lanes];  ///< vertex positions by axis; unused ones repeat another
    std::uint16_t
        triangle[mesh_lanes];  ///< vertex indices of its corners in the leaf, three bits each, the first one lowest
    std::uint32_t first;       ///< index of its first triangle in the tree's order; the others follow
    std::uint32_t used;        ///< one bit for each triangle
    /// The extent |x| + |y| + |z| of its box, rounded up; infinite if the products of such numbers overflow or
    /// underflow.
    float extent;
    /// A ray that sees a triangle of it with more than half of this area doesn't graze it.
    float min_area;

    std::uint32_t count() const { return static_cast<std::uint32_t>(std::popcount(used)); }
    Vec3 position(std::uint32_t number) const { return {corner[0][number], corner[1][number], corner[2][number]}; }
    Triangle3 at(std::uint32_t lane) const {
        const std::uint32_t numbers = triangle[lane];
        return {position(numbers & 7u), position(numbers >> 3 & 7u), position(numbers >> 6 & 7u)};
    }
};

/// An inner node of eight children. Its boxes are padded.
struct alignas(32) MeshNode : BvhRows<3> {
    std::uint32_t child[mesh_lanes];  ///< bvh_none where unused
};

static_assert(sizeof(MeshLeaf) == 128 && sizeof(MeshNode) == 224);

/// Products of three numbers up to this fit in a float.
inline constexpr double max_mesh_extent = 1e12;

struct MeshTree {
    std::vector<MeshNode, LargePages<MeshNode>> nodes;
    std::vector<MeshLeaf, LargePages<MeshLeaf>> leaves;
    /// The input's triangles in the order of the leaves.
    std::vector<std::uint32_t, LargePages<std::uint32_t>> order;
    std::array<BvhRoot<3>, 2> roots;  ///< as in a Bvh; the second root of a mesh is empty
    DVec<3> middle{0.0};              ///< middle of the mesh's box
    double off_center = 0;            ///< |x| + |y| + |z| of the middle
    /// |x| + |y| + |z| from the middle to a corner of the box; infinite if a coordinate exceeds max_mesh_extent.
    double spread = 0;

    const BvhRoot<3>& root(std::size_t kind) const { return roots[kind]; }
    const MeshNode& node(std::uint32_t ref) const { return nodes[ref]; }
    const MeshLeaf& leaf(std::uint32_t ref) const { return leaves[ref & ~bvh_leaf_bit]; }
};

/// `same` maps each point to the lowest index at its position. There is at least one triangle; all numbers are finite.
MeshTree build_mesh_tree(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                         std::span<const std::uint32_t> same);

/// Visits the triangles whose boxes overlap the box.
void find_overlapping(const MeshTree& tree, const Aabb3& box, ItemCall visit);
/// Visits the triangles that a ray or moving box touches within reach, and few others; nearest child first.
void find_within(const MeshTree& tree, const RayReach<3>& reach, ReachCall visit);
/// Visits the triangles whose boxes are within reach of a box; nearest child first.
void find_within(const MeshTree& tree, const BoxReach<3>& reach, ReachCall visit);

}  // namespace abut::detail
