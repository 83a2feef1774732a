#pragma once

// Capacity growth of lists that grow item by item.

#include <vector>

namespace abut::detail {

/// Reserves capacity for one more entry. Capacity grows by a quarter: doubling it leaves up to half of the memory
/// unused.
template <class T>
void reserve_one_more(std::vector<T>& list) {
    constexpr std::size_t part = 4, min_growth = 16;
    if (list.size() == list.capacity()) list.reserve(list.size() + list.size() / part + min_growth);
}

}  // namespace abut::detail
