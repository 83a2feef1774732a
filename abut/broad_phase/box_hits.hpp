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
std::uint64_t overlap_bits(const BoxColumns<D>& boxes, std::size_t first, std::size_t count, const Aabb<D>& box);

/// Every overlapping pair of a box from [first, last) with one behind it and before `end`, in the order of both.
template <int D>
void each_hit(const BoxColumns<D>& boxes, std::size_t first, std::size_t last, std::size_t end, HitsCall visit);

/// The same for boxes sorted by their lower bound on axis 0, each up to the first that begins behind its upper bound.
/// A box of NaNs ends the sorted run before it; one must be the last.
template <int D>
void each_sorted_hit(const BoxColumns<D>& boxes, std::size_t first, std::size_t last, HitsCall visit);

}  // namespace abut
