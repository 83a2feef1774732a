// Box queries of a mesh's tree (overlap, moving box, nearest first) on the boxes of its triangles. Compiled for each
// SIMD target by Highway, which selects one at run time.

#include <abut/shape/mesh/tree.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/shape/mesh/box_queries.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/shape/mesh/triangle_simd-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// Computes the boxes of a leaf's triangles, with their indices in the mesh.
struct LeafBoxes {
    const MeshTree& tree;

    detail::BvhLeaf<3> operator()(std::uint32_t ref) const {
        const MeshLeaf& leaf = tree.leaf(ref);
        detail::BvhLeaf<3> result;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const LeafNumbers numbers(leaf, lane);
            const V3 a = numbers.pick<0>(leaf.corner), b = numbers.pick<1>(leaf.corner),
                     c = numbers.pick<2>(leaf.corner);
            hn::Store(hn::Min(hn::Min(a.x, b.x), c.x), bvh_tag, result.min[0] + lane);
            hn::Store(hn::Min(hn::Min(a.y, b.y), c.y), bvh_tag, result.min[1] + lane);
            hn::Store(hn::Min(hn::Min(a.z, b.z), c.z), bvh_tag, result.min[2] + lane);
            hn::Store(hn::Max(hn::Max(a.x, b.x), c.x), bvh_tag, result.max[0] + lane);
            hn::Store(hn::Max(hn::Max(a.y, b.y), c.y), bvh_tag, result.max[1] + lane);
            hn::Store(hn::Max(hn::Max(a.z, b.z), c.z), bvh_tag, result.max[2] + lane);
        }
        const std::uint32_t count = leaf.count();
        for (std::uint32_t lane = 0; lane < count; ++lane) result.index[lane] = tree.order[leaf.first + lane];
        for (std::uint32_t lane = count; lane < mesh_lanes; ++lane) {
            result.clear(lane);
            result.index[lane] = detail::bvh_none;
        }
        return result;
    }
};

void overlapping_boxes(const MeshTree& tree, const Aabb3& box, ItemCall visit) {
    visit_overlapping<3>(tree, LeafBoxes{tree}, box, visit);
}
void along_boxes(const MeshTree& tree, const RayReach<3>& reach, ReachCall visit) {
    visit_along<3>(tree, LeafBoxes{tree}, reach, visit);
}
void near_boxes(const MeshTree& tree, const BoxReach<3>& reach, ReachCall visit) {
    visit_near<3>(tree, LeafBoxes{tree}, reach, visit);
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(overlapping_boxes);
HWY_EXPORT(along_boxes);
HWY_EXPORT(near_boxes);

void find_overlapping(const MeshTree& tree, const Aabb3& box, ItemCall visit) {
    const Aabb3 query = usable(box);
    if (!is_empty(query)) HWY_DYNAMIC_DISPATCH(overlapping_boxes)(tree, query, visit);
}
void find_within(const MeshTree& tree, const RayReach<3>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(along_boxes)(tree, reach, visit);
}
void find_within(const MeshTree& tree, const BoxReach<3>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(near_boxes)(tree, reach, visit);
}

}  // namespace abut::detail
#endif
