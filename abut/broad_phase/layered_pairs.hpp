#pragma once

// The pairs that meet in some cells of a LayeredGrid. For .cpp files.

#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/layered_items.hpp>

#include <cstdint>

namespace abut {

/// Of the cells from `begin` up to `end`: the pairs in each, and those of what is in it with what is in the cells
/// around it. Every pair of items with a cell comes from just one cell. Returns false where the visitor has had enough.
bool pairs_of_cells(const LayeredItems<2>& items, const LayeredPlan<2>& plan, std::uint32_t begin, std::uint32_t end,
                    PairBuffer& pairs);
bool pairs_of_cells(const LayeredItems<3>& items, const LayeredPlan<3>& plan, std::uint32_t begin, std::uint32_t end,
                    PairBuffer& pairs);

}  // namespace abut
