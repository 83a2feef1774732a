#pragma once

// Views of items where they are, each made once while many questions are asked about a few of them. For .cpp files.

#include <abut/shape/view.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace abut {

template <int D>
class PlacedViews {
public:
    /// The view of a slot, by `make()` where it is not there. Valid until the next call.
    template <class Make>
    const View<D>& of(std::uint32_t slot, const Make& make) {
        Entry& entry = entries_[slot % entries_.size()];
        if (!entry.view || entry.slot != slot) {
            entry.slot = slot;
            entry.view.emplace(make());
        }
        return *entry.view;
    }

private:
    struct Entry {
        std::uint32_t slot = 0;
        std::optional<View<D>> view;
    };
    std::array<Entry, 16> entries_;
};

}  // namespace abut
