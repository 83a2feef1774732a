// Highway compiles this file once for each SIMD target and dispatches at run time. All targets work in groups of 16
// boxes, so that they report the same overlaps in the same order.

#include <abut/broad_phase/detail/box_overlaps.hpp>
#include <abut/math/simd/dispatch-inl.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/detail/box_overlaps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, box_lanes>;
using Vector = hn::Vec<Lanes>;
using Mask = hn::Mask<Lanes>;
constexpr Lanes d;
constexpr std::size_t lanes = hn::MaxLanes(d);

std::uint32_t bits_of(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    if constexpr (lanes <= 8) return bytes[0];
    // Reading the mask as one 16-bit number avoids splitting it into bytes and joining them again.
    std::uint16_t bits;
    std::memcpy(&bits, bytes, sizeof bits);
    if constexpr (std::endian::native == std::endian::big) bits = static_cast<std::uint16_t>(bits << 8 | bits >> 8);
    return bits;
}

/// One box, broadcast to all lanes.
template <int D>
class BroadcastBox {
public:
    explicit BroadcastBox(const Aabb<D>& box) {
        for (int axis = 0; axis < D; ++axis) {
            min_[axis] = hn::Set(d, box.min[axis]);
            max_[axis] = hn::Set(d, box.max[axis]);
        }
    }

    /// Lanes whose box begins before this one ends, on axis 0.
    Mask begins_before_end(const BoxSoaView<D>& boxes, std::size_t i) const {
        return hn::Le(hn::LoadU(d, boxes.min[0] + i), max_[0]);
    }
    Mask overlaps(const BoxSoaView<D>& boxes, std::size_t i, int axis) const {
        return hn::And(hn::Le(hn::LoadU(d, boxes.min[axis] + i), max_[axis]),
                       hn::Ge(hn::LoadU(d, boxes.max[axis] + i), min_[axis]));
    }
    /// The overlap bits of the lanes from i on.
    std::uint32_t overlap_bits_of_lanes(const BoxSoaView<D>& boxes, std::size_t i) const {
        Mask hit = overlaps(boxes, i, 0);
        for (int axis = 1; axis < D; ++axis) hit = hn::And(hit, overlaps(boxes, i, axis));
        return bits_of(hit);
    }
    /// The overlap bits of the box_lanes boxes from i on.
    std::uint32_t overlap_bits(const BoxSoaView<D>& boxes, std::size_t i) const {
        std::uint32_t result = 0;
        for (std::size_t part = 0; part < box_lanes; part += lanes)
            result |= overlap_bits_of_lanes(boxes, i + part) << part;
        return result;
    }

private:
    Vector min_[D], max_[D];
};

/// Batches overlaps for the visitor. `add` writes every entry and advances only past those with a bit: the branch
/// would be unpredictable.
class OverlapBuffer {
public:
    explicit OverlapBuffer(BoxOverlapsCall visit) : visit_(visit) {}

    bool add(std::size_t box, std::size_t first, std::uint32_t bits) {
        overlaps_[count_] = {static_cast<std::uint32_t>(box), static_cast<std::uint32_t>(first), bits};
        count_ += bits != 0 ? 1 : 0;
        return count_ < overlaps_.size() || flush();
    }
    bool flush() {
        const std::size_t count = count_;
        count_ = 0;
        return visit_({overlaps_.data(), count});
    }

private:
    BoxOverlapsCall visit_;
    std::size_t count_ = 0;
    std::array<BoxOverlaps, 256> overlaps_;
};

std::uint32_t low_bits(std::size_t count) {
    return count < box_lanes ? (1u << count) - 1 : (1u << box_lanes) - 1;
}

template <int D>
std::uint64_t overlap_bits_of(const BoxSoaView<D>& boxes, std::size_t first, std::size_t count, const Aabb<D>& box) {
    const BroadcastBox<D> lanes_of_box(box);
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < count; i += lanes)
        result |= std::uint64_t{lanes_of_box.overlap_bits_of_lanes(boxes, first + i)} << i;
    return count < 64 ? result & ((std::uint64_t{1} << count) - 1) : result;
}

template <int D>
void overlaps_of(const BoxSoaView<D>& boxes, std::size_t first, std::size_t last, std::size_t end,
                 BoxOverlapsCall visit) {
    OverlapBuffer overlaps(visit);
    for (std::size_t i = first; i < last; ++i) {
        const BroadcastBox<D> box(boxes[i]);
        for (std::size_t k = i + 1; k < end; k += box_lanes)
            if (!overlaps.add(i, k, box.overlap_bits(boxes, k) & low_bits(end - k))) return;
    }
    overlaps.flush();
}

template <int D>
void sorted_overlaps_of(const BoxSoaView<D>& boxes, std::size_t first, std::size_t last, BoxOverlapsCall visit) {
    constexpr std::uint32_t all = (1u << box_lanes) - 1;
    OverlapBuffer overlaps(visit);
    for (std::size_t i = first; i < last; ++i) {
        const BroadcastBox<D> box(boxes[i]);
        std::uint32_t in_run = all;
        for (std::size_t k = i + 1; in_run == all; k += box_lanes) {
            std::uint32_t bits = 0;
            in_run = 0;
            for (std::size_t part = 0; part < box_lanes; part += lanes) {
                const Mask begins = box.begins_before_end(boxes, k + part);
                Mask hit = begins;
                for (int axis = 1; axis < D; ++axis) hit = hn::And(hit, box.overlaps(boxes, k + part, axis));
                in_run |= bits_of(begins) << part;
                bits |= bits_of(hit) << part;
            }
            // Only the unbroken run of bits from the lowest on counts: another sorted run may begin after it.
            if (!overlaps.add(i, k, bits & in_run & ~(in_run + 1))) return;
        }
    }
    overlaps.flush();
}

template <int D>
void bounds_of_blocks(const BoxSoaView<D>& boxes, const std::uint32_t* marks, std::uint32_t excluded,
                      std::size_t blocks, std::size_t begin, BoxSoa<D>& result) {
    const hn::Rebind<std::uint32_t, Lanes> marks_d;
    constexpr float far = std::numeric_limits<float>::infinity();
    const Vector minus_infinity = hn::Set(d, -far), plus_infinity = hn::Set(d, far);
    const auto bits = hn::Set(marks_d, excluded), none = hn::Zero(marks_d);
    for (std::size_t block = 0; block < blocks; ++block) {
        Vector low[D], high[D];
        for (int axis = 0; axis < D; ++axis) {
            low[axis] = plus_infinity;
            high[axis] = minus_infinity;
        }
        for (std::size_t i = block * box_lanes; i < (block + 1) * box_lanes; i += lanes) {
            const Vector first_bound = hn::LoadU(d, boxes.min[0] + i);
            const Mask is_marked_in = hn::RebindMask(d, hn::Eq(hn::And(hn::LoadU(marks_d, marks + i), bits), none));
            const Mask in = hn::And(is_marked_in, hn::Eq(first_bound, first_bound));
            for (int axis = 0; axis < D; ++axis) {
                low[axis] = hn::Min(low[axis], hn::IfThenElse(in, hn::LoadU(d, boxes.min[axis] + i), plus_infinity));
                high[axis] = hn::Max(high[axis], hn::IfThenElse(in, hn::LoadU(d, boxes.max[axis] + i), minus_infinity));
            }
        }
        Aabb<D> box;
        for (int axis = 0; axis < D; ++axis) {
            box.min[axis] = hn::GetLane(hn::MinOfLanes(d, low[axis]));
            box.max[axis] = hn::GetLane(hn::MaxOfLanes(d, high[axis]));
        }
        result.set(begin + block, box);
    }
}

ABUT_NAME_DIMENSIONS(overlap_bits_of);
ABUT_NAME_DIMENSIONS(overlaps_of);
ABUT_NAME_DIMENSIONS(sorted_overlaps_of);
ABUT_NAME_DIMENSIONS(bounds_of_blocks);

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

ABUT_EXPORT_DIMENSIONS(overlap_bits_of);
ABUT_EXPORT_DIMENSIONS(overlaps_of);
ABUT_EXPORT_DIMENSIONS(sorted_overlaps_of);
ABUT_EXPORT_DIMENSIONS(bounds_of_blocks);

template <int D>
std::uint64_t overlap_bits(const BoxSoaView<D>& boxes, std::size_t first, std::size_t count, const Aabb<D>& box) {
    return dispatched_overlap_bits_of<D>()(boxes, first, count, box);
}

template <int D>
void each_overlap(const BoxSoaView<D>& boxes, std::size_t first, std::size_t last, std::size_t end,
                  BoxOverlapsCall visit) {
    dispatched_overlaps_of<D>()(boxes, first, last, end, visit);
}

template <int D>
void each_sorted_overlap(const BoxSoaView<D>& boxes, std::size_t first, std::size_t last, BoxOverlapsCall visit) {
    dispatched_sorted_overlaps_of<D>()(boxes, first, last, visit);
}

template <int D>
void block_bounds(const BoxSoaView<D>& boxes, const std::uint32_t* marks, std::uint32_t excluded, std::size_t blocks,
                  std::size_t begin, BoxSoa<D>& result) {
    dispatched_bounds_of_blocks<D>()(boxes, marks, excluded, blocks, begin, result);
}

#define ABUT_INSTANTIATE(D)                                                                                         \
    template std::uint64_t overlap_bits(const BoxSoaView<D>&, std::size_t, std::size_t, const Aabb<D>&);            \
    template void each_overlap(const BoxSoaView<D>&, std::size_t, std::size_t, std::size_t, BoxOverlapsCall);       \
    template void each_sorted_overlap(const BoxSoaView<D>&, std::size_t, std::size_t, BoxOverlapsCall);             \
    template void block_bounds(const BoxSoaView<D>&, const std::uint32_t*, std::uint32_t, std::size_t, std::size_t, \
                               BoxSoa<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
#endif
