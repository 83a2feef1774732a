#pragma once

// The overlapping pairs of one tree, or of two, as tasks. For .cpp files.

#include <abut/broad_phase/bvh/tree.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>

#include <cstdint>

namespace abut::detail {

/// The pairs of an item below node `a` and an item below node `b`. If `b` is bvh_none: the pairs of two items below
/// `a`.
template <int D>
struct BvhPairTask {
    std::uint32_t a, b;
    Aabb<D> box_a, box_b;
};

/// If both trees are the same object, the lower index of a pair comes first. Returns false if the visitor stops the
/// search.
template <int D>
bool find_pairs(const BvhTree<D>& a, const BvhTree<D>& b, const BvhPairTask<D>& task, PairBuffer& pairs);

template <>
bool find_pairs<2>(const BvhTree<2>&, const BvhTree<2>&, const BvhPairTask<2>&, PairBuffer&);
template <>
bool find_pairs<3>(const BvhTree<3>&, const BvhTree<3>&, const BvhPairTask<3>&, PairBuffer&);

}  // namespace abut::detail
