#pragma once

// A direct-mapped cache of values of items.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

namespace abut::detail {

/// Nothing is cached, and no memory taken, before the first clear().
template <class Value>
class SlotCache {
public:
    explicit SlotCache(std::size_t count) : count_(count) {}

    /// The value of a slot, made by `make()` if it isn't cached. Valid until the next call.
    template <class Make>
    Value& of(std::uint32_t slot, const Make& make) {
        const std::size_t place = slot % count_;
        if (slots_[place] != slot) {
            slots_[place] = slot;
            std::construct_at(&values_[place], make());
        }
        return values_[place];
    }
    void clear() {
        values_.resize(count_);
        slots_.assign(count_, none);
    }

private:
    static_assert(std::is_trivially_destructible_v<Value>);
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    std::size_t count_;
    std::vector<std::uint32_t> slots_;
    std::vector<Value> values_;
};

}  // namespace abut::detail
