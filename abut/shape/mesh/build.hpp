#pragma once

// Building blocks of a mesh's tree. For .cpp files.

#include <abut/broad_phase/bvh/node.hpp>
#include <abut/broad_phase/bvh/split.hpp>
#include <abut/shape/mesh/tree.hpp>

#include <cstdint>

namespace abut::detail {

/// The box of a triangle, padded by the tolerance of ray hits. `all` grows by the unpadded box.
BvhItem item_of(const Triangle3& triangle, std::uint32_t index, Aabb3& all);

/// The extent |x| + |y| + |z| of the box of a leaf's vertices, for error bounds.
float extent_of(const MeshLeaf& leaf);

/// Sets the root; `exact` is the box of all triangles without padding.
void set_root(MeshTree& tree, std::uint32_t ref, const Aabb3& exact);

}  // namespace abut::detail
