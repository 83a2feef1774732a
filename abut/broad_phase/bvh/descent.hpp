#pragma once

// The path of a new item from the root to a leaf. For .cpp files.

#include <abut/broad_phase/bvh/node.hpp>

namespace abut::detail {

/// Returns the leaf below `ref` whose boxes grow least by a new box, and enlarges the boxes of the nodes above it.
std::uint32_t descend(BvhNode<2>* nodes, std::uint32_t ref, const Aabb<2>& box);
std::uint32_t descend(BvhNode<3>* nodes, std::uint32_t ref, const Aabb<3>& box);

}  // namespace abut::detail
