#pragma once

// What of a tree a box overlaps, a ray touches, or is near. For .cpp files.

#include <abut/broad_phase/bvh_tree.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/visit.hpp>

namespace abut {

/// `box` is from `usable`.
void find_overlapping(const BvhTree<2>& tree, const Aabb<2>& box, ItemCall visit);
void find_overlapping(const BvhTree<3>& tree, const Aabb<3>& box, ItemCall visit);

/// Roughly nearest first: of the parts of a node the nearest, the rest as they come.
void find_within(const BvhTree<2>& tree, const Ray<2>& ray, ReachCall visit);
void find_within(const BvhTree<3>& tree, const Ray<3>& ray, ReachCall visit);
void find_within(const BvhTree<2>& tree, const RayReach<2>& reach, ReachCall visit);
void find_within(const BvhTree<3>& tree, const RayReach<3>& reach, ReachCall visit);
void find_within(const BvhTree<2>& tree, const BoxReach<2>& reach, ReachCall visit);
void find_within(const BvhTree<3>& tree, const BoxReach<3>& reach, ReachCall visit);

}  // namespace abut
