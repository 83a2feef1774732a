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

// Functions without templates, as HWY_EXPORT needs.
#define ABUT_FOR_DIMENSION(D)                                                           \
    void overlapping_##D(const BvhTree<D>& tree, const Aabb<D>& box, ItemCall visit) {  \
        visit_overlapping<D>(tree, leaves_of(tree), box, visit);                        \
    }                                                                                   \
    void along_ray_##D(const BvhTree<D>& tree, const Ray<D>& ray, ReachCall visit) {    \
        visit_along_ray<D>(tree, leaves_of(tree), ray, visit);                          \
    }                                                                                   \
    void along_##D(const BvhTree<D>& tree, const RayReach<D>& reach, ReachCall visit) { \
        visit_along<D>(tree, leaves_of(tree), reach, visit);                            \
    }                                                                                   \
    void near_##D(const BvhTree<D>& tree, const BoxReach<D>& reach, ReachCall visit) {  \
        visit_near<D>(tree, leaves_of(tree), reach, visit);                             \
    }
ABUT_FOR_DIMENSION(2)
ABUT_FOR_DIMENSION(3)
#undef ABUT_FOR_DIMENSION

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

#define ABUT_FOR_DIMENSION(D)                                                             \
    HWY_EXPORT(overlapping_##D);                                                          \
    HWY_EXPORT(along_ray_##D);                                                            \
    HWY_EXPORT(along_##D);                                                                \
    HWY_EXPORT(near_##D);                                                                 \
    void find_overlapping(const BvhTree<D>& tree, const Aabb<D>& box, ItemCall visit) {   \
        HWY_DYNAMIC_DISPATCH(overlapping_##D)(tree, box, visit);                          \
    }                                                                                     \
    void find_within(const BvhTree<D>& tree, const Ray<D>& ray, ReachCall visit) {        \
        HWY_DYNAMIC_DISPATCH(along_ray_##D)(tree, ray, visit);                            \
    }                                                                                     \
    void find_within(const BvhTree<D>& tree, const RayReach<D>& reach, ReachCall visit) { \
        HWY_DYNAMIC_DISPATCH(along_##D)(tree, reach, visit);                              \
    }                                                                                     \
    void find_within(const BvhTree<D>& tree, const BoxReach<D>& reach, ReachCall visit) { \
        HWY_DYNAMIC_DISPATCH(near_##D)(tree, reach, visit);                               \
    }
ABUT_FOR_DIMENSION(2)
ABUT_FOR_DIMENSION(3)
#undef ABUT_FOR_DIMENSION

}  // namespace abut::detail
#endif
