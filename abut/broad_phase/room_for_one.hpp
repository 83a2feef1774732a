#pragma once

// How lists that grow item by item get room.

#include <vector>

namespace abut {

/// Room for one more entry. A quarter more at a time: twice as many would leave up to half of the memory unused.
template <class T>
void make_room_for_one(std::vector<T>& list) {
    constexpr std::size_t part = 4, few = 16;
    if (list.size() == list.capacity()) list.reserve(list.size() + list.size() / part + few);
}

}  // namespace abut
