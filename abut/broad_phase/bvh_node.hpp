#pragma once

// The parts of a Bvh, and how they are put together. Not for users.

#include <abut/math/aabb.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// A node of the tree. Nodes lie depth first: the left child of node k is node k + 1.
template <int D>
struct BvhNode {
    Vec<D> min;
    std::uint32_t first;  ///< of a leaf: its first item; else: the right child
    Vec<D> max;
    std::uint32_t count;  ///< of a leaf: how many items; else 0
};

/// An item of a leaf. Its box lies here, for locality.
template <int D>
struct BvhItem {
    Aabb<D> box;
    std::uint32_t index;       ///< in the span that the user gave
    std::uint32_t unused = 0;  ///< fills the item up to whole registers: twice as fast to swap
};

static_assert(sizeof(BvhNode<3>) == 32 && sizeof(BvhItem<3>) == 32);
static_assert(sizeof(BvhNode<2>) == 24 && sizeof(BvhItem<2>) == 24);

/// No tree is deeper: 64 levels split where it costs least (the parting at the root is one of them), and 32 that halve
/// would do for 2^32 items.
inline constexpr int bvh_depth = 64 + 32;

/// Orders the items for the leaves and makes the nodes, without their bounds. The items from `bounded` on are those
/// without bound on some side. Does nothing where there are no items.
template <int D>
void build_nodes(std::vector<BvhItem<D>>& items, std::size_t bounded, std::vector<BvhNode<D>>& nodes);

}  // namespace abut
