#pragma once

// Boxes against many boxes at once, by vector units. For .cpp files.

#include <abut/broad_phase/box_table.hpp>
#include <abut/math/function_ref.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace abut {

/// Box `box` overlaps box `first + k` for every bit k.
struct BoxHits {
    std::uint32_t box;
    std::uint32_t first;
    std::uint32_t bits;  ///< at least one, at most box_lanes
};
using HitsCall = FunctionRef<bool(std::span<const BoxHits>)>;  ///< false stops

/// Which of up to 64 boxes from `first` on overlap this one: a bit each.
template <int D>
std::uint64_t overlap_bits(const BoxRows<D>& boxes, std::size_t first, std::size_t count, const Aabb<D>& box);

/// Every overlapping pair of a box from [first, last) with one behind it and before `end`, in the order of both.
template <int D>
void each_hit(const BoxRows<D>& boxes, std::size_t first, std::size_t last, std::size_t end, HitsCall visit);

/// The same for boxes sorted by their lower bound on axis 0, each up to the first that begins behind its upper bound.
/// A box of NaNs ends the sorted run before it; one must be the last.
template <int D>
void each_sorted_hit(const BoxRows<D>& boxes, std::size_t first, std::size_t last, HitsCall visit);

/// The common boxes of 16 boxes each, from the first on, into result[begin], ...; without those of NaNs and those
/// whose mark has one of the bits `left_out`. Aabb::empty() where none is left.
template <int D>
void common_boxes(const BoxRows<D>& boxes, const std::uint32_t* marks, std::uint32_t left_out, std::size_t blocks,
                  std::size_t begin, BoxTable<D>& result);

}  // namespace abut
