#pragma once

// Pairs in the one order that doesn't depend on who found them.

#include <abut/broad_phase/visit.hpp>

#include <vector>

namespace abut {

/// Sorts pairs by (i, j), each of which is there once, by as many bits as their numbers have. From some dozens of
/// pairs on the vector grows to twice its size and shrinks again: where its capacity is twice the number of pairs,
/// nothing is allocated.
void sort_pairs(std::vector<ItemPair>& pairs);

}  // namespace abut
