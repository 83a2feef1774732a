#pragma once

// The name of an item in a world, and of a pair of them.

#include <compare>
#include <cstdint>

namespace abut {

/// A value; the default one names nothing. The name of a removed item is never given to another.
struct Id {
    std::uint32_t index = 0;       ///< from 1; small numbers, for arrays of the user's
    std::uint32_t generation = 0;  ///< tells the items apart that had this index one after the other

    explicit operator bool() const { return index != 0; }
    friend auto operator<=>(const Id&, const Id&) = default;
};

struct IdPair {
    Id a, b;  ///< a < b

    friend auto operator<=>(const IdPair&, const IdPair&) = default;
};

}  // namespace abut
