#pragma once

// A list of entries for each item, all of them side by side.

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Allocates nothing once it has held as many.
template <class Entry>
class SlotLists {
public:
    /// `each(add)` calls add(slot, make_entry) any number of times, and is called twice: to count the entries, and to
    /// take them.
    template <class Each>
    void build(std::size_t slots, Each&& each) {
        first_.assign(slots + 1, 0);
        each([this](std::uint32_t slot, const auto&) { ++first_[slot]; });
        std::uint32_t sum = 0;
        for (std::uint32_t& first : first_) first = sum += first;
        entries_.resize(sum);
        // From behind, so that each slot's beginning is where it should be in the end.
        each([this](std::uint32_t slot, const auto& make_entry) { entries_[--first_[slot]] = make_entry(); });
    }

    std::span<const Entry> of(std::uint32_t slot) const {
        return std::span(entries_).subspan(first_[slot], first_[slot + 1] - first_[slot]);
    }

private:
    std::vector<std::uint32_t> first_;  // by slot; after the last one, their number
    std::vector<Entry> entries_;
};

}  // namespace abut
