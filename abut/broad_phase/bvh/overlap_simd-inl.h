// Overlap tests of eight boxes against one in SIMD. Included once for each Highway target. The tests only compare
// numbers, so that all targets agree.

#if defined(ABUT_BVH_OVERLAP_SIMD) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_BVH_OVERLAP_SIMD
#undef ABUT_BVH_OVERLAP_SIMD
#else
#define ABUT_BVH_OVERLAP_SIMD
#endif

#include <abut/broad_phase/bvh/node.hpp>

#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using BvhVectorTag = hn::CappedTag<float, bvh_lanes>;
using BvhVector = hn::Vec<BvhVectorTag>;
using BvhMask = hn::Mask<BvhVectorTag>;
constexpr BvhVectorTag bvh_tag;
constexpr std::uint32_t bvh_step = hn::MaxLanes(bvh_tag);

inline std::uint32_t bits_of(BvhMask mask) {
    std::uint8_t bytes[8];
    hn::StoreMaskBits(bvh_tag, mask, bytes);
    return bytes[0];
}

/// Tests eight boxes against one box, with the bounds min(axis) and max(axis). Bit k is set if box k overlaps it.
template <int D, class Min, class Max>
HWY_INLINE std::uint32_t lanes_in_bounds(const BvhRows<D>& rows, Min min, Max max) {
    std::uint32_t result = 0;
    for (std::uint32_t lane = 0; lane < bvh_lanes; lane += bvh_step) {
        BvhMask mask = hn::Le(hn::Load(bvh_tag, rows.min[0] + lane), hn::Set(bvh_tag, max(0)));
        mask = hn::And(mask, hn::Le(hn::Set(bvh_tag, min(0)), hn::Load(bvh_tag, rows.max[0] + lane)));
        for (int i = 1; i < D; ++i) {
            mask = hn::And(mask, hn::Le(hn::Load(bvh_tag, rows.min[i] + lane), hn::Set(bvh_tag, max(i))));
            mask = hn::And(mask, hn::Le(hn::Set(bvh_tag, min(i)), hn::Load(bvh_tag, rows.max[i] + lane)));
        }
        result |= bits_of(mask) << lane;
    }
    return result;
}

template <int D>
HWY_INLINE std::uint32_t overlapping_lanes(const BvhRows<D>& rows, const Aabb<D>& box) {
    return lanes_in_bounds<D>(
        rows, [&](int i) { return box.min[i]; }, [&](int i) { return box.max[i]; });
}

/// Tests eight boxes against box `lane` of `others`.
template <int D>
HWY_INLINE std::uint32_t overlapping_lanes(const BvhRows<D>& rows, const BvhRows<D>& others, std::uint32_t lane) {
    return lanes_in_bounds<D>(
        rows, [&](int i) { return others.min[i][lane]; }, [&](int i) { return others.max[i][lane]; });
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
