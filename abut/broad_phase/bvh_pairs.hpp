#pragma once

// The pairs of a tree, or of two, cut into tasks. For .cpp files.

#include <abut/broad_phase/bvh_tree.hpp>
#include <abut/broad_phase/pair_buffer.hpp>

#include <cstdint>

namespace abut {

/// The pairs of what is below one node with what is below another; where `b` is bvh_none, of all below `a` with one
/// another.
template <int D>
struct BvhPairTask {
    std::uint32_t a, b;
    Aabb<D> box_a, box_b;
};

/// Where both trees are one object, the lower index is told first. False where the visitor has had enough.
template <int D>
bool find_pairs(const BvhTree<D>& a, const BvhTree<D>& b, const BvhPairTask<D>& task, PairBuffer& pairs);

template <>
bool find_pairs<2>(const BvhTree<2>&, const BvhTree<2>&, const BvhPairTask<2>&, PairBuffer&);
template <>
bool find_pairs<3>(const BvhTree<3>&, const BvhTree<3>&, const BvhPairTask<3>&, PairBuffer&);

}  // namespace abut
