#pragma once

// Overlap tests of one box against many, by SIMD. For .cpp files.

#include <abut/broad_phase/detail/box_soa.hpp>
#include <abut/math/function_ref.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace abut::detail {

/// The overlaps of box `box` among consecutive boxes: bit k is set if it overlaps box `first + k`.
struct BoxOverlaps {
    std::uint32_t box;
    std::uint32_t first;
    std::uint32_t bits;  ///< not 0; only the lowest box_lanes bits are used
};
using BoxOverlapsCall = FunctionRef<bool(std::span<const BoxOverlaps>)>;  ///< false stops

/// Tests up to 64 boxes from `first` on against `box`. Bit k is set if box `first + k` overlaps it.
template <int D>
std::uint64_t overlap_bits(const BoxSoaView<D>& boxes, std::size_t first, std::size_t count, const Aabb<D>& box);

/// Visits every overlapping pair (i, k) with i in [first, last) and i < k < end, in lexicographic order.
template <int D>
void each_overlap(const BoxSoaView<D>& boxes, std::size_t first, std::size_t last, std::size_t end,
                  BoxOverlapsCall visit);

/// Visits the overlapping pairs of boxes that are sorted by their lower bounds on axis 0: the inner loop of sweep and
/// prune. The scan from each box ends at the first box that begins beyond its upper bound. A box of NaNs ends a sorted
/// run; the last box must be one.
template <int D>
void each_sorted_overlap(const BoxSoaView<D>& boxes, std::size_t first, std::size_t last, BoxOverlapsCall visit);

/// Writes the bounds of each block of 16 boxes to result[begin], result[begin + 1], ... Boxes of NaNs and boxes whose
/// mark has a bit of `excluded` don't count. The bounds of a block without boxes are Aabb::empty().
template <int D>
void block_bounds(const BoxSoaView<D>& boxes, const std::uint32_t* marks, std::uint32_t excluded, std::size_t blocks,
                  std::size_t begin, BoxSoa<D>& result);

}  // namespace abut::detail
