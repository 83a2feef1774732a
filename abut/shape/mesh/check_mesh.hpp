#pragma once

// Checks of a mesh whose data come from outside as they are. For .cpp files.

#include <abut/shape/mesh/surface.hpp>

#include <cstddef>
#include <string_view>

namespace abut::detail {

/// What is wrong with loaded data, and the index of the triangle, leaf or node. Null `what`: nothing.
struct MeshFault {
    const char* what = nullptr;
    std::size_t index = 0;
};

/// Checks everything but the points and the corners of the triangles; `exact` is the box of all triangles. Without a
/// fault no query leaves the data, has numbers that are not finite, or takes longer than a search of all triangles:
/// every number names something, each leaf and each node but the root is the child of one node, the tree is of limited
/// depth, each triangle is in one leaf, and each leaf or node is within the box of its parent.
///
/// Not checked, since it takes as long as everything else: whether the leaves have the corners of the triangles,
/// whether triangles that are called neighbours are adjacent, and whether a mesh that says so is closed.
MeshFault fault_of(const MeshSurface& surface, const Aabb3& exact);

}  // namespace abut::detail
