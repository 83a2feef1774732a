// Queries of a Bvh. Highway compiles this file once for each SIMD target and dispatches at run time.

#include <abut/broad_phase/bvh/queries.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/bvh/queries.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/broad_phase/bvh/traversal-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// A functor that returns the leaf of a reference.
template <int D>
auto leaves_of(const BvhTree<D>& tree) {
    return [&tree](std::uint32_t ref) -> const BvhLeaf<D>& { return tree.leaf(ref); };
}

void overlapping_2(const BvhTree<2>& tree, const Aabb<2>& box, ItemCall visit) {
    visit_overlapping<2>(tree, leaves_of(tree), box, visit);
}
void overlapping_3(const BvhTree<3>& tree, const Aabb<3>& box, ItemCall visit) {
    visit_overlapping<3>(tree, leaves_of(tree), box, visit);
}
void along_ray_2(const BvhTree<2>& tree, const Ray<2>& ray, ReachCall visit) {
    visit_along_ray<2>(tree, leaves_of(tree), ray, visit);
}
void along_2(const BvhTree<2>& tree, const RayReach<2>& reach, ReachCall visit) {
    visit_along<2>(tree, leaves_of(tree), reach, visit);
}
void along_ray_3(const BvhTree<3>& tree, const Ray<3>& ray, ReachCall visit) {
    visit_along_ray<3>(tree, leaves_of(tree), ray, visit);
}
void along_3(const BvhTree<3>& tree, const RayReach<3>& reach, ReachCall visit) {
    visit_along<3>(tree, leaves_of(tree), reach, visit);
}
void near_2(const BvhTree<2>& tree, const BoxReach<2>& reach, ReachCall visit) {
    visit_near<2>(tree, leaves_of(tree), reach, visit);
}
void near_3(const BvhTree<3>& tree, const BoxReach<3>& reach, ReachCall visit) {
    visit_near<3>(tree, leaves_of(tree), reach, visit);
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(overlapping_2);
HWY_EXPORT(overlapping_3);
HWY_EXPORT(along_ray_2);
HWY_EXPORT(along_2);
HWY_EXPORT(along_ray_3);
HWY_EXPORT(along_3);
HWY_EXPORT(near_2);
HWY_EXPORT(near_3);

void find_overlapping(const BvhTree<2>& tree, const Aabb<2>& box, ItemCall visit) {
    HWY_DYNAMIC_DISPATCH(overlapping_2)(tree, box, visit);
}
void find_overlapping(const BvhTree<3>& tree, const Aabb<3>& box, ItemCall visit) {
    HWY_DYNAMIC_DISPATCH(overlapping_3)(tree, box, visit);
}
void find_within(const BvhTree<2>& tree, const Ray<2>& ray, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(along_ray_2)(tree, ray, visit);
}
void find_within(const BvhTree<2>& tree, const RayReach<2>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(along_2)(tree, reach, visit);
}
void find_within(const BvhTree<3>& tree, const Ray<3>& ray, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(along_ray_3)(tree, ray, visit);
}
void find_within(const BvhTree<3>& tree, const RayReach<3>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(along_3)(tree, reach, visit);
}
void find_within(const BvhTree<2>& tree, const BoxReach<2>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(near_2)(tree, reach, visit);
}
void find_within(const BvhTree<3>& tree, const BoxReach<3>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(near_3)(tree, reach, visit);
}

}  // namespace abut::detail
#endif
