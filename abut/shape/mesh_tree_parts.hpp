#pragma once

// What a mesh's tree is put together from. For .cpp files.

#include <abut/broad_phase/bvh_node.hpp>
#include <abut/broad_phase/bvh_split.hpp>
#include <abut/shape/mesh_tree.hpp>

#include <cstdint>

namespace abut {

/// The box of a triangle, wider by what the search for a ray's hit may take for hit. `all` grows by what it is.
BvhItem item_of(const Triangle3& triangle, std::uint32_t index, Aabb3& all);

/// Of the box around a leaf's corners, |x| + |y| + |z|, for bounds on what is calculated with them.
float extent_of(const MeshLeaf& leaf);

/// With the box around all triangles, as they are.
void set_root(MeshTree& tree, std::uint32_t ref, const Aabb3& exact);

}  // namespace abut
