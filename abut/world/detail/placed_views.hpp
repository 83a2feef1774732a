#pragma once

// A direct-mapped cache of the views of items at their poses, for many pairs of the same items.

#include <abut/shape/view/view.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

namespace abut::detail {

/// It takes no memory before its first use, and a copy is empty.
template <int D>
class PlacedViews {
public:
    PlacedViews() = default;
    PlacedViews(const PlacedViews&) noexcept : PlacedViews() {}
    PlacedViews& operator=(const PlacedViews&) noexcept {
        clear();
        return *this;
    }
    PlacedViews(PlacedViews&&) noexcept = default;
    PlacedViews& operator=(PlacedViews&&) noexcept = default;
    ~PlacedViews() = default;

    /// The view of a slot, made by `make()` if it isn't cached. Valid until the next call.
    template <class Make>
    const View<D>& of(std::uint32_t slot, const Make& make) {
        if (views_.empty()) {
            views_.resize(count);
            slots_.assign(count, none);
        }
        const std::size_t place = slot % count;
        if (slots_[place] != slot) {
            slots_[place] = slot;
            std::construct_at(&views_[place], make());
        }
        return views_[place];
    }
    void clear() { std::fill(slots_.begin(), slots_.end(), none); }

private:
    static_assert(std::is_trivially_destructible_v<View<D>>);
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    /// They fit in the second cache of common processors.
    static constexpr std::size_t count = 1024;
    std::vector<std::uint32_t> slots_;
    std::vector<View<D>> views_;
};

}  // namespace abut::detail
