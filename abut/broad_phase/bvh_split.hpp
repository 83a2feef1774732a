#pragma once

// Where to part the items of a tree that is built. For .cpp files.

#include <abut/broad_phase/bvh_node.hpp>

#include <algorithm>
#include <cstdint>

namespace abut {

/// The most items that make one node whose children are leaves alone.
inline constexpr std::uint32_t bvh_node_items = bvh_lanes * bvh_lanes;

inline constexpr std::uint32_t bvh_leaves_for(std::uint32_t items) {
    return (items + bvh_lanes - 1) / bvh_lanes;
}

/// How many leaves some items may take: a quarter more than they need, for a split is best where it parts clusters,
/// and not where it fills leaves.
inline constexpr std::uint32_t bvh_leaves_granted(std::uint32_t items) {
    const auto granted = static_cast<std::uint32_t>(std::uint64_t{items} * 5 / (4 * bvh_lanes));
    return std::max(granted, bvh_leaves_for(items));
}

/// Some items of an array, that will hang on one node.
template <int D>
struct BvhRange {
    std::uint32_t begin, end;
    std::uint32_t leaves;  ///< may be made of it, at least bvh_leaves_for(count())
    int depth;             ///< splits above it
    Aabb<D> box;

    std::uint32_t count() const { return end - begin; }
};

/// All of the items.
template <int D>
BvhRange<D> whole_range(const BvhItem* items, std::uint32_t begin, std::uint32_t end, int depth);

/// Reorders the items of a range of more than 8, and parts it in two that are not empty. Items without bound are
/// halved; others are parted where it costs least, as far as the leaves granted allow.
template <int D>
void split(BvhItem* items, bool bounded, const BvhRange<D>& range, BvhRange<D>& left, BvhRange<D>& right);

template <>
BvhRange<2> whole_range<2>(const BvhItem*, std::uint32_t, std::uint32_t, int);
template <>
BvhRange<3> whole_range<3>(const BvhItem*, std::uint32_t, std::uint32_t, int);
template <>
void split<2>(BvhItem*, bool, const BvhRange<2>&, BvhRange<2>&, BvhRange<2>&);
template <>
void split<3>(BvhItem*, bool, const BvhRange<3>&, BvhRange<3>&, BvhRange<3>&);

}  // namespace abut
