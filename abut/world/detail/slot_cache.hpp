#pragma once

// A direct-mapped cache of values of items.

#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <vector>

namespace abut::detail {

/// Nothing is cached, and no memory taken, before the first clear().
template <class Value, std::size_t count>
class SlotCache {
public:
    /// The value of a slot, made by `make()` if it isn't cached. Valid until the next call.
    template <class Make>
    Value& of(std::uint32_t slot, const Make& make) {
        const std::size_t place = slot % count;
        if (slots_[place] != slot) {
            slots_[place] = slot;
            new (&values_[place]) Value(make());  // in place, which std::construct_at isn't
        }
        return values_[place];
    }
    /// Whether the value of one slot replaces that of the other.
    bool share_place(std::uint32_t slot, std::uint32_t other) const { return slot % count == other % count; }
    void clear() {
        values_.resize(count);
        slots_.assign(count, none);
    }

private:
    static_assert(std::is_trivially_destructible_v<Value>);
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    std::vector<std::uint32_t> slots_;
    std::vector<Value> values_;
};

}  // namespace abut::detail
