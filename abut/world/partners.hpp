#pragma once

// Who is near whom, item by item.

#include <abut/math/aabb.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// For each slot those that it pairs with and whose boxes overlap its own. Allocates nothing once it has held as many.
template <int D>
class Partners {
public:
    struct Partner {
        Aabb<D> box;
        std::uint32_t slot;
    };

    /// `each(add)` calls add(slot, partner) any number of times, and is called twice: to count them, and to take them.
    template <class Each>
    void build(std::size_t slots, Each&& each) {
        first_.assign(slots + 1, 0);
        each([this](std::uint32_t slot, const auto&) { ++first_[slot]; });
        std::uint32_t sum = 0;
        for (std::uint32_t& first : first_) first = sum += first;
        partners_.resize(sum);
        // From behind, so that each slot's beginning is where it should be in the end.
        each([this](std::uint32_t slot, const auto& partner) { partners_[--first_[slot]] = partner(); });
    }

    std::span<const Partner> of(std::uint32_t slot) const {
        return std::span(partners_).subspan(first_[slot], first_[slot + 1] - first_[slot]);
    }

private:
    std::vector<std::uint32_t> first_;  // by slot; after the last one, their number
    std::vector<Partner> partners_;
};

}  // namespace abut
