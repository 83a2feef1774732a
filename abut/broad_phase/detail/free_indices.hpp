#pragma once

// The indices of erased items, for reuse by new ones. For .cpp files and the headers of classes that hold them.

#include <abut/broad_phase/boxes.hpp>
#include <abut/math/aabb.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace abut::detail {

class FreeIndices {
public:
    bool contains(std::uint32_t index) const { return index < is_free_.size() && is_free_[index] != 0; }

    void add(std::uint32_t index) {
        if (index >= is_free_.size()) is_free_.resize(std::size_t{index} + 1, 0);
        is_free_[index] = 1;
        min_heap_.push_back(index);
        std::push_heap(min_heap_.begin(), min_heap_.end(), std::greater<>());
    }
    /// Removes and returns the smallest free index; `otherwise` if none is free.
    std::uint32_t take(std::uint32_t otherwise) {
        if (min_heap_.empty()) return otherwise;
        std::pop_heap(min_heap_.begin(), min_heap_.end(), std::greater<>());
        const std::uint32_t result = min_heap_.back();
        min_heap_.pop_back();
        is_free_[result] = 0;
        return result;
    }
    void clear() {
        is_free_.clear();
        min_heap_.clear();
    }
    /// Removes the indices whose boxes are not empty: an update has put them to use again.
    template <int D>
    void remove_used(std::span<const Aabb<D>> boxes) {
        const auto is_used = [&](std::uint32_t index) {
            if (is_empty(usable(boxes[index]))) return false;
            is_free_[index] = 0;
            return true;
        };
        if (std::erase_if(min_heap_, is_used) > 0) std::make_heap(min_heap_.begin(), min_heap_.end(), std::greater<>());
    }

private:
    std::vector<std::uint8_t> is_free_;  ///< by index, up to the highest that was ever erased
    std::vector<std::uint32_t> min_heap_;
};

}  // namespace abut::detail
