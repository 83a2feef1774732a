#pragma once

// Building blocks of a mesh's tree. For .cpp files.

#include <abut/broad_phase/bvh/node.hpp>
#include <abut/broad_phase/bvh/split.hpp>
#include <abut/shape/mesh/tree.hpp>

#include <cstdint>
#include <limits>

namespace abut::detail {

/// The box of a triangle, padded by the tolerance of ray hits. `all` grows by the unpadded box.
BvhItem item_of(const Triangle3& triangle, std::uint32_t index, Aabb3& all);

/// Sets the sizes in a leaf that serve error bounds, when its triangles are complete.
void set_sizes(MeshLeaf& leaf);

/// Marks a box of a node as unused. The infinite bounds of the first axis put it out of the reach of every ray, however
/// minima and maxima of NaN come out; comparisons with the NaN of the others exclude it for every box.
inline void clear_box(MeshNode& node, std::uint32_t lane) {
    node.clear(lane);
    node.min[0][lane] = std::numeric_limits<float>::infinity();
    node.max[0][lane] = -std::numeric_limits<float>::infinity();
}

/// Sets the root; `exact` is the box of all triangles without padding.
void set_root(MeshTree& tree, std::uint32_t ref, const Aabb3& exact);

}  // namespace abut::detail
