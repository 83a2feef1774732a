#pragma once

// A direct-mapped cache of views of items at their poses, for many queries about a few items.

#include <abut/shape/view/view.hpp>

#include <cstdint>
#include <vector>

namespace abut::detail {

template <int D>
class ViewCache {
public:
    /// The view of a slot, made by `make()` if it isn't cached. Valid until the next call.
    template <class Make>
    const View<D>& of(std::uint32_t slot, const Make& make) {
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
    static constexpr std::size_t count = 256;
    struct Entry {
        std::uint32_t slot = none;
        View<D> view;
    };
    std::vector<Entry> entries_ = std::vector<Entry>(count);
};

}  // namespace abut::detail
