#pragma once

// Numbers of items that were erased, to be given to new ones. For .cpp files and those headers that hold them.

#include <abut/broad_phase/boxes.hpp>
#include <abut/math/aabb.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace abut {

class FreeItems {
public:
    bool contains(std::uint32_t item) const { return item < is_free_.size() && is_free_[item] != 0; }

    void add(std::uint32_t item) {
        if (item >= is_free_.size()) is_free_.resize(std::size_t{item} + 1, 0);
        is_free_[item] = 1;
        least_first_.push_back(item);
        std::push_heap(least_first_.begin(), least_first_.end(), std::greater<>());
    }
    /// The least of them, which is free no more; `otherwise` where there is none.
    std::uint32_t take(std::uint32_t otherwise) {
        if (least_first_.empty()) return otherwise;
        std::pop_heap(least_first_.begin(), least_first_.end(), std::greater<>());
        const std::uint32_t result = least_first_.back();
        least_first_.pop_back();
        is_free_[result] = 0;
        return result;
    }
    void clear() {
        is_free_.clear();
        least_first_.clear();
    }
    /// Those that have a box again are in use again.
    template <int D>
    void keep_empty(std::span<const Aabb<D>> boxes) {
        const auto in_use = [&](std::uint32_t item) {
            if (is_empty(usable(boxes[item]))) return false;
            is_free_[item] = 0;
            return true;
        };
        if (std::erase_if(least_first_, in_use) > 0)
            std::make_heap(least_first_.begin(), least_first_.end(), std::greater<>());
    }

private:
    std::vector<std::uint8_t> is_free_;       ///< by item, as far as any was erased
    std::vector<std::uint32_t> least_first_;  ///< a heap
};

}  // namespace abut
