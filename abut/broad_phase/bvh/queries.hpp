#pragma once

// The overlapping pairs of one tree, or of two, and the items that a box overlaps, that a ray touches, or that are near
// a box. For .cpp files.

#include <abut/broad_phase/bvh/tree.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/visit.hpp>

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

/// Requires a box from `usable`.
void find_overlapping(const BvhTree<2>& tree, const Aabb<2>& box, ItemCall visit);
void find_overlapping(const BvhTree<3>& tree, const Aabb<3>& box, ItemCall visit);

/// Visits the items roughly nearest first: at each node the nearest child first, the others in the order of their
/// lanes.
void find_within(const BvhTree<2>& tree, const Ray<2>& ray, ReachCall visit);
void find_within(const BvhTree<3>& tree, const Ray<3>& ray, ReachCall visit);
void find_within(const BvhTree<2>& tree, const RayReach<2>& reach, ReachCall visit);
void find_within(const BvhTree<3>& tree, const RayReach<3>& reach, ReachCall visit);
void find_within(const BvhTree<2>& tree, const BoxReach<2>& reach, ReachCall visit);
void find_within(const BvhTree<3>& tree, const BoxReach<3>& reach, ReachCall visit);

}  // namespace abut::detail
