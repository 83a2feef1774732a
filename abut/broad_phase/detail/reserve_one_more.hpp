#pragma once

// Capacity growth of lists that grow item by item.

#include <vector>

namespace abut::detail {

/// Not inlined, so that its callers stay small.
template <class T>
[[gnu::noinline]] void reserve_a_quarter_more(std::vector<T>& list) {
    constexpr std::size_t part = 4, min_growth = 16;
    list.reserve(list.size() + list.size() / part + min_growth);
}

/// Reserves capacity for one more entry. Capacity grows by a quarter: doubling it leaves up to half of the memory
/// unused.
template <class T>
void reserve_one_more(std::vector<T>& list) {
    if (list.size() == list.capacity()) reserve_a_quarter_more(list);
}

}  // namespace abut::detail
