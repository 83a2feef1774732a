#pragma once

// A subtree that is built by itself, in memory of its own. Internal.

#include <abut/broad_phase/bvh/node.hpp>
#include <abut/broad_phase/bvh/split.hpp>

#include <cstdint>
#include <vector>

namespace abut::detail {

/// The maximum number of items of a subtree, which fits into the cache of one core.
inline constexpr std::uint32_t bvh_subtree_items = 2048;

template <int D>
struct BvhSubtree {
    std::vector<BvhItem> items;
    std::vector<BvhNode<D>> nodes;  ///< depth first; children and parents are indices into these vectors
    std::vector<BvhLeaf<D>> leaves;
    std::vector<std::uint32_t> node_slots, leaf_slots;  ///< their indices in the whole tree
    std::uint32_t root = bvh_none;

    /// Reserves capacity for a subtree of so many items, whatever their boxes.
    void reserve(std::uint32_t count) {
        // The lowest nodes have at least 24 items; few have so few.
        const std::size_t max_nodes = count / 16 + bvh_lanes, max_leaves = bvh_max_leaves(count) + bvh_lanes;
        items.reserve(count);
        nodes.reserve(max_nodes);
        leaves.reserve(max_leaves);
        node_slots.reserve(max_nodes + bvh_lanes);
        leaf_slots.reserve(max_leaves + bvh_lanes);
    }
};

template <int D>
BvhItem item_of(const Aabb<D>& box, std::uint32_t index) {
    BvhItem result{{0, 0, 0}, index, {0, 0, 0}, 0};
    for (int i = 0; i < D; ++i) {
        result.min[i] = box.min[i];
        result.max[i] = box.max[i];
    }
    return result;
}

/// Builds the nodes and leaves of the items; there must be at least one. `depth` is the number of splits above.
template <int D>
void build_subtree(BvhSubtree<D>& subtree, bool bounded, int depth);

/// The sum of the areas of the children. An empty child has the area 0.
template <int D>
double children_area(const BvhNode<D>& node);

}  // namespace abut::detail
