#pragma once

// Views of items where they are, each made once while many questions are asked about a few of them.

#include <abut/shape/view/view.hpp>

#include <cstdint>
#include <vector>

namespace abut {

template <int D>
class PlacedViews {
public:
    /// The view of a slot, by `make()` where it is not there. Valid until the next call. Allocates in the first one.
    template <class Make>
    const View<D>& of(std::uint32_t slot, const Make& make) {
        if (entries_.empty()) entries_.resize(count);
        Entry& entry = entries_[slot % count];
        if (entry.slot != slot) {
            entry.slot = slot;
            entry.view = make();
        }
        return entry.view;
    }
    void clear() {
        for (Entry& entry : entries_) entry.slot = none;
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    static constexpr std::size_t count = 64;
    struct Entry {
        std::uint32_t slot = none;
        View<D> view;
    };
    std::vector<Entry> entries_;
};

}  // namespace abut
