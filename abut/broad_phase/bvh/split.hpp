#pragma once

// Splits of the items of a node during a build. For .cpp files.

#include <abut/broad_phase/bvh/node.hpp>

#include <algorithm>
#include <cstdint>

namespace abut::detail {

/// The maximum number of items of a node whose children are all leaves.
inline constexpr std::uint32_t bvh_node_items = bvh_lanes * bvh_lanes;

/// The minimum number of leaves for so many items.
inline constexpr std::uint32_t bvh_min_leaves(std::uint32_t items) {
    return (items + bvh_lanes - 1) / bvh_lanes;
}

/// The maximum number of leaves for so many items: a quarter above the minimum, for the best split separates clusters
/// and doesn't fill leaves.
inline constexpr std::uint32_t bvh_max_leaves(std::uint32_t items) {
    const auto result = static_cast<std::uint32_t>(std::uint64_t{items} * 5 / (4 * bvh_lanes));
    return std::max(result, bvh_min_leaves(items));
}

/// A range of items in an array, which becomes one subtree.
template <int D>
struct BvhRange {
    std::uint32_t begin, end;
    std::uint32_t leaves;  ///< their maximum number in the subtree, at least bvh_min_leaves(count())
    int depth;             ///< the number of splits above it
    Aabb<D> box;

    std::uint32_t count() const { return end - begin; }
};

/// The range of all items from `begin` to `end`.
template <int D>
BvhRange<D> whole_range(const BvhItem* items, std::uint32_t begin, std::uint32_t end, int depth);

/// Reorders the items of a range of more than 8 and splits it in two ranges that are not empty. Unbounded items are
/// split at the median; others are split by SAH within the limit on leaves.
template <int D>
void split(BvhItem* items, bool bounded, const BvhRange<D>& range, BvhRange<D>& left, BvhRange<D>& right);

}  // namespace abut::detail
