#pragma once

// The canonical order of pairs, which doesn't depend on the structure that found them.

#include <abut/broad_phase/visit.hpp>

#include <vector>

namespace abut::detail {

/// Sorts pairs by (i, j), by radix sort from 64 pairs on. The pairs must be distinct. For that the vector grows to
/// twice its size and shrinks again: nothing is allocated if its capacity is twice the number of pairs.
void sort_pairs(std::vector<ItemPair>& pairs);

}  // namespace abut::detail
