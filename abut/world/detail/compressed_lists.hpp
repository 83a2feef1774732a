#pragma once

// Lists of entries by item, stored one after another in one array (compressed sparse rows, CSR).

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// One list for each slot. Building allocates nothing once the lists have held as many entries.
template <class Entry>
class CompressedLists {
public:
    /// `each(add)` calls add(slot, make_entry) for every entry. It runs twice: the first run counts the entries, the
    /// second stores them.
    template <class Each>
    void build(std::size_t slots, Each&& each) {
        first_.assign(slots + 1, 0);
        each([this](std::uint32_t slot, const auto&) { ++first_[slot]; });
        std::uint32_t sum = 0;
        for (std::uint32_t& first : first_) first = sum += first;
        entries_.resize(sum);
        // Each list fills from its end, so that first_[slot] is the beginning of the list afterwards.
        each([this](std::uint32_t slot, const auto& make_entry) { entries_[--first_[slot]] = make_entry(); });
    }

    void reserve(std::size_t slots, std::size_t entries) {
        first_.reserve(slots + 1);
        entries_.reserve(entries);
    }

    std::span<const Entry> of(std::uint32_t slot) const {
        return std::span(entries_).subspan(first(slot), first_[slot + 1] - first(slot));
    }
    /// The index of the first entry of a list among all entries.
    std::uint32_t first(std::uint32_t slot) const { return first_[slot]; }
    std::span<const Entry> all() const { return entries_; }

private:
    std::vector<std::uint32_t> first_;  // by slot; the last element is the number of entries
    std::vector<Entry> entries_;
};

}  // namespace abut::detail
