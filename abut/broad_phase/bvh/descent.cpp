// The descent of an insertion. Highway compiles this file once for each SIMD target and dispatches at run time. Every
// operation rounds alike on all targets, so that the tree is the same.

#include <abut/broad_phase/bvh/descent.hpp>
#include <abut/math/simd/dispatch-inl.h>

#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/bvh/descent.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/broad_phase/bvh/overlap_simd-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// The lane of the child whose sum of extents grows least by a box; among equals, the child with the smallest sum.
/// The sum of extents stands for the area: it takes fewer operations, makes as good a tree, and doesn't overflow.
template <int D>
HWY_INLINE std::uint32_t lane_of_least_growth(const BvhRows<D>& rows, const Aabb<D>& box) {
    constexpr std::uint32_t steps = bvh_lanes / bvh_step;
    // Unbounded boxes are clamped.
    const BvhVector far = hn::Set(bvh_tag, 1e37f), minus_far = hn::Set(bvh_tag, -1e37f), zero = hn::Zero(bvh_tag);
    const BvhVector none = hn::Set(bvh_tag, std::numeric_limits<float>::infinity());
    BvhVector growths[steps], min_growth = none;
    for (std::uint32_t step = 0; step < steps; ++step) {
        const std::uint32_t lane = step * bvh_step;
        BvhVector growth = zero, sum = zero;
        for (int i = 0; i < D; ++i) {
            const BvhVector low = hn::Max(hn::Load(bvh_tag, rows.min[i] + lane), minus_far);
            const BvhVector high = hn::Min(hn::Load(bvh_tag, rows.max[i] + lane), far);
            const BvhVector below = hn::Sub(low, hn::Max(hn::Set(bvh_tag, box.min[i]), minus_far));
            const BvhVector above = hn::Sub(hn::Min(hn::Set(bvh_tag, box.max[i]), far), high);
            growth = hn::Add(growth, hn::Add(hn::Max(below, zero), hn::Max(above, zero)));
            sum = hn::Add(sum, hn::Sub(high, low));
        }
        const BvhMask used = hn::Le(hn::Load(bvh_tag, rows.min[0] + lane), hn::Load(bvh_tag, rows.max[0] + lane));
        growth = hn::Add(growth, hn::Mul(sum, hn::Set(bvh_tag, 0x1p-20f)));
        growths[step] = hn::IfThenElse(used, growth, none);
        min_growth = hn::Min(min_growth, growths[step]);
    }
    min_growth = hn::MinOfLanes(bvh_tag, min_growth);
    std::uint32_t bits = 0;
    for (std::uint32_t step = 0; step < steps; ++step)
        bits |= bits_of(hn::Eq(growths[step], min_growth)) << step * bvh_step;
    return static_cast<std::uint32_t>(std::countr_zero(bits));
}

template <int D>
std::uint32_t descend(BvhNode<D>* nodes, std::uint32_t ref, const Aabb<D>& box) {
    while (!is_leaf(ref)) {
        BvhNode<D>& node = nodes[ref];
        const std::uint32_t lane = lane_of_least_growth<D>(node, box);
        node.set(lane, node.min[0][lane] <= node.max[0][lane] ? merged(node.box(lane), box) : box);
        ref = node.child[lane];
    }
    return ref;
}

ABUT_NAME_DIMENSIONS(descend);

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

ABUT_EXPORT_DIMENSIONS(descend);

std::uint32_t descend(BvhNode<2>* nodes, std::uint32_t ref, const Aabb<2>& box) {
    return dispatched_descend<2>()(nodes, ref, box);
}
std::uint32_t descend(BvhNode<3>* nodes, std::uint32_t ref, const Aabb<3>& box) {
    return dispatched_descend<3>()(nodes, ref, box);
}

}  // namespace abut::detail
#endif
