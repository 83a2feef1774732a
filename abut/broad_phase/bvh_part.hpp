#pragma once

// A part of a tree, put together by itself. Not for users.

#include <abut/broad_phase/bvh_node.hpp>
#include <abut/broad_phase/bvh_split.hpp>

#include <cstdint>
#include <vector>

namespace abut {

/// The most items of a part: what a core holds in its own cache.
inline constexpr std::uint32_t bvh_part_items = 2048;

template <int D>
struct BvhPart {
    std::vector<BvhItem> items;
    std::vector<BvhNode<D>> nodes;  ///< depth first; children and parents by their places here
    std::vector<BvhLeaf<D>> leaves;
    std::vector<std::uint32_t> node_slots, leaf_slots;  ///< where they go
    std::uint32_t root = bvh_none;

    /// Room for so many items, whatever their places.
    void reserve(std::uint32_t count) {
        // A node has 24 items at least, and nodes above it; few have so few.
        const std::size_t most_nodes = count / 16 + bvh_lanes, most_leaves = bvh_leaves_granted(count) + bvh_lanes;
        items.reserve(count);
        nodes.reserve(most_nodes);
        leaves.reserve(most_leaves);
        node_slots.reserve(most_nodes + bvh_lanes);
        leaf_slots.reserve(most_leaves + bvh_lanes);
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

/// Makes the nodes and leaves of the items, which are one at least. `depth` tells how many splits lie above.
template <int D>
void grow(BvhPart<D>& part, bool bounded, int depth);

/// The areas of the children together; of those that hold nothing it is 0.
template <int D>
double area_of(const BvhNode<D>& node);

}  // namespace abut
