#pragma once

// The identifiers of a world's items, and of pairs of items.

#include <compare>
#include <cstdint>

namespace abut {

/// Identifies an item. The default value is null. No other item gets the id of a removed one.
struct Id {
    std::uint32_t index = 0;       ///< starts at 1 and stays small, so that users can index arrays with it
    std::uint32_t generation = 0;  ///< distinguishes the items that use this index one after another

    explicit operator bool() const { return index != 0; }
    friend auto operator<=>(const Id&, const Id&) = default;
};

/// Identifies a pair of items.
struct IdPair {
    Id a, b;  ///< a < b

    friend auto operator<=>(const IdPair&, const IdPair&) = default;
};

}  // namespace abut
