// Compiled once for each kind of vector unit by Highway, which takes the best of them when the program runs. Groups of
// 16 boxes on all of them, so that what is told, and in which order, is the same.

#include <abut/broad_phase/box_hits.hpp>

#include <array>
#include <bit>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/box_hits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

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
    // Read as one number where it is one: put together from bytes, it would be taken apart before.
    std::uint16_t both;
    std::memcpy(&both, bytes, sizeof both);
    if constexpr (std::endian::native == std::endian::big) both = static_cast<std::uint16_t>(both << 8 | both >> 8);
    return both;
}

/// A box in every lane.
template <int D>
class Spread {
public:
    explicit Spread(const Aabb<D>& box) {
        for (int axis = 0; axis < D; ++axis) {
            min_[axis] = hn::Set(d, box.min[axis]);
            max_[axis] = hn::Set(d, box.max[axis]);
        }
    }

    Mask begins(const BoxRows<D>& boxes, std::size_t i) const {
        return hn::Le(hn::LoadU(d, boxes.min[0] + i), max_[0]);
    }
    Mask overlaps(const BoxRows<D>& boxes, std::size_t i, int axis) const {
        return hn::And(hn::Le(hn::LoadU(d, boxes.min[axis] + i), max_[axis]),
                       hn::Ge(hn::LoadU(d, boxes.max[axis] + i), min_[axis]));
    }
    /// Of the box_lanes boxes from i on.
    std::uint32_t overlap_bits(const BoxRows<D>& boxes, std::size_t i) const {
        std::uint32_t result = 0;
        for (std::size_t part = 0; part < box_lanes; part += lanes) {
            Mask hit = overlaps(boxes, i + part, 0);
            for (int axis = 1; axis < D; ++axis) hit = hn::And(hit, overlaps(boxes, i + part, axis));
            result |= bits_of(hit) << part;
        }
        return result;
    }

private:
    Vector min_[D], max_[D];
};

/// What was found, until there is enough of it to tell. Writes always and keeps what has a bit: nobody can guess that.
class HitBuffer {
public:
    explicit HitBuffer(HitsCall visit) : visit_(visit) {}

    bool add(std::size_t box, std::size_t first, std::uint32_t bits) {
        hits_[count_] = {static_cast<std::uint32_t>(box), static_cast<std::uint32_t>(first), bits};
        count_ += bits != 0 ? 1 : 0;
        return count_ < hits_.size() || flush();
    }
    bool flush() {
        const std::size_t count = count_;
        count_ = 0;
        return visit_({hits_.data(), count});
    }

private:
    HitsCall visit_;
    std::size_t count_ = 0;
    std::array<BoxHits, 256> hits_;
};

std::uint32_t low_bits(std::size_t count) {
    return count < box_lanes ? (1u << count) - 1 : (1u << box_lanes) - 1;
}

template <int D>
std::uint64_t overlap_bits_of(const BoxRows<D>& boxes, std::size_t first, std::size_t count, const Aabb<D>& box) {
    const Spread<D> spread(box);
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < count; i += box_lanes)
        result |= std::uint64_t{spread.overlap_bits(boxes, first + i) & low_bits(count - i)} << i;
    return result;
}

template <int D>
void hits_of(const BoxRows<D>& boxes, std::size_t first, std::size_t last, std::size_t end, HitsCall visit) {
    HitBuffer hits(visit);
    for (std::size_t i = first; i < last; ++i) {
        const Spread<D> box(boxes[i]);
        for (std::size_t k = i + 1; k < end; k += box_lanes)
            if (!hits.add(i, k, box.overlap_bits(boxes, k) & low_bits(end - k))) return;
    }
    hits.flush();
}

template <int D>
void sorted_hits_of(const BoxRows<D>& boxes, std::size_t first, std::size_t last, HitsCall visit) {
    constexpr std::uint32_t all = (1u << box_lanes) - 1;
    HitBuffer hits(visit);
    for (std::size_t i = first; i < last; ++i) {
        const Spread<D> box(boxes[i]);
        std::uint32_t in_run = all;
        for (std::size_t k = i + 1; in_run == all; k += box_lanes) {
            std::uint32_t bits = 0;
            in_run = 0;
            for (std::size_t part = 0; part < box_lanes; part += lanes) {
                const Mask begins = box.begins(boxes, k + part);
                Mask hit = begins;
                for (int axis = 1; axis < D; ++axis) hit = hn::And(hit, box.overlaps(boxes, k + part, axis));
                in_run |= bits_of(begins) << part;
                bits |= bits_of(hit) << part;
            }
            // Of the run the bits from the lowest on, up to the first that is none: behind it another run may begin.
            if (!hits.add(i, k, bits & in_run & ~(in_run + 1))) return;
        }
    }
    hits.flush();
}

template <int D>
void common_boxes_of(const BoxRows<D>& boxes, const std::uint32_t* marks, std::uint32_t left_out, std::size_t blocks,
                     std::size_t begin, BoxTable<D>& result) {
    const hn::Rebind<std::uint32_t, Lanes> marks_d;
    constexpr float far = std::numeric_limits<float>::infinity();
    const Vector least = hn::Set(d, -far), most = hn::Set(d, far);
    const auto bits = hn::Set(marks_d, left_out), none = hn::Zero(marks_d);
    for (std::size_t block = 0; block < blocks; ++block) {
        Vector low[D], high[D];
        for (int axis = 0; axis < D; ++axis) {
            low[axis] = most;
            high[axis] = least;
        }
        for (std::size_t i = block * box_lanes; i < (block + 1) * box_lanes; i += lanes) {
            const Vector any = hn::LoadU(d, boxes.min[0] + i);
            const Mask wanted = hn::RebindMask(d, hn::Eq(hn::And(hn::LoadU(marks_d, marks + i), bits), none));
            const Mask in = hn::And(wanted, hn::Eq(any, any));
            for (int axis = 0; axis < D; ++axis) {
                low[axis] = hn::Min(low[axis], hn::IfThenElse(in, hn::LoadU(d, boxes.min[axis] + i), most));
                high[axis] = hn::Max(high[axis], hn::IfThenElse(in, hn::LoadU(d, boxes.max[axis] + i), least));
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

// Names that a table of functions can be made of.
#define ABUT_FOR_DIMENSION(D)                                                                                      \
    std::uint64_t overlap_bits_##D(const BoxRows<D>& boxes, std::size_t first, std::size_t count,                  \
                                   const Aabb<D>& box) {                                                           \
        return overlap_bits_of(boxes, first, count, box);                                                          \
    }                                                                                                              \
    void hits_##D(const BoxRows<D>& boxes, std::size_t first, std::size_t last, std::size_t end, HitsCall visit) { \
        hits_of(boxes, first, last, end, visit);                                                                   \
    }                                                                                                              \
    void sorted_hits_##D(const BoxRows<D>& boxes, std::size_t first, std::size_t last, HitsCall visit) {           \
        sorted_hits_of(boxes, first, last, visit);                                                                 \
    }                                                                                                              \
    void common_boxes_##D(const BoxRows<D>& boxes, const std::uint32_t* marks, std::uint32_t left_out,             \
                          std::size_t blocks, std::size_t begin, BoxTable<D>& result) {                            \
        common_boxes_of(boxes, marks, left_out, blocks, begin, result);                                            \
    }
ABUT_FOR_DIMENSION(2)
ABUT_FOR_DIMENSION(3)
#undef ABUT_FOR_DIMENSION

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(overlap_bits_2);
HWY_EXPORT(overlap_bits_3);
HWY_EXPORT(hits_2);
HWY_EXPORT(hits_3);
HWY_EXPORT(sorted_hits_2);
HWY_EXPORT(sorted_hits_3);
HWY_EXPORT(common_boxes_2);
HWY_EXPORT(common_boxes_3);

template <int D>
std::uint64_t overlap_bits(const BoxRows<D>& boxes, std::size_t first, std::size_t count, const Aabb<D>& box) {
    if constexpr (D == 2)
        return HWY_DYNAMIC_DISPATCH(overlap_bits_2)(boxes, first, count, box);
    else
        return HWY_DYNAMIC_DISPATCH(overlap_bits_3)(boxes, first, count, box);
}

template <int D>
void each_hit(const BoxRows<D>& boxes, std::size_t first, std::size_t last, std::size_t end, HitsCall visit) {
    if constexpr (D == 2)
        HWY_DYNAMIC_DISPATCH(hits_2)(boxes, first, last, end, visit);
    else
        HWY_DYNAMIC_DISPATCH(hits_3)(boxes, first, last, end, visit);
}

template <int D>
void each_sorted_hit(const BoxRows<D>& boxes, std::size_t first, std::size_t last, HitsCall visit) {
    if constexpr (D == 2)
        HWY_DYNAMIC_DISPATCH(sorted_hits_2)(boxes, first, last, visit);
    else
        HWY_DYNAMIC_DISPATCH(sorted_hits_3)(boxes, first, last, visit);
}

template <int D>
void common_boxes(const BoxRows<D>& boxes, const std::uint32_t* marks, std::uint32_t left_out, std::size_t blocks,
                  std::size_t begin, BoxTable<D>& result) {
    if constexpr (D == 2)
        HWY_DYNAMIC_DISPATCH(common_boxes_2)(boxes, marks, left_out, blocks, begin, result);
    else
        HWY_DYNAMIC_DISPATCH(common_boxes_3)(boxes, marks, left_out, blocks, begin, result);
}

template std::uint64_t overlap_bits(const BoxRows<2>&, std::size_t, std::size_t, const Aabb<2>&);
template std::uint64_t overlap_bits(const BoxRows<3>&, std::size_t, std::size_t, const Aabb<3>&);
template void each_hit(const BoxRows<2>&, std::size_t, std::size_t, std::size_t, HitsCall);
template void each_hit(const BoxRows<3>&, std::size_t, std::size_t, std::size_t, HitsCall);
template void each_sorted_hit(const BoxRows<2>&, std::size_t, std::size_t, HitsCall);
template void each_sorted_hit(const BoxRows<3>&, std::size_t, std::size_t, HitsCall);
template void common_boxes(const BoxRows<2>&, const std::uint32_t*, std::uint32_t, std::size_t, std::size_t,
                           BoxTable<2>&);
template void common_boxes(const BoxRows<3>&, const std::uint32_t*, std::uint32_t, std::size_t, std::size_t,
                           BoxTable<3>&);

}  // namespace abut
#endif
