#pragma once

// Near pairs, and what their tests find in an update.

#include <abut/world/detail/found_contacts.hpp>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut::detail {

/// The slots of two near items, the lower one first.
struct SlotPair {
    std::uint32_t a = 0, b = 0;

    friend auto operator<=>(const SlotPair&, const SlotPair&) = default;
};

/// A touching pair.
struct TouchingSlots {
    SlotPair slots;            ///< in the order of the ids
    std::uint32_t begin, end;  ///< of its contacts, among those found
};

/// What the tests of near pairs find.
template <int D>
struct PairResults {
    std::vector<TouchingSlots> touching;  ///< in the order of the tests, or sorted
    FoundContacts<D> found;               ///< of the touching pairs, in the order of the tests
    std::vector<WorldImpact<D>> impacts;  ///< of continuous pairs that didn't touch at the last update
    std::vector<IdPair> passed;           ///< pairs with an impact that don't touch at the end
    std::size_t tested = 0, balls = 0;    ///< see UpdateCounts

    void clear() {
        touching.clear();
        found.clear();
        impacts.clear();
        passed.clear();
        tested = balls = 0;
    }
    /// For the results of this many pairs without parts.
    void reserve(std::size_t pairs) {
        touching.reserve(pairs);
        found.reserve(pairs);
    }
    /// For as many results as others have memory for.
    void reserve_like(const PairResults& other) {
        touching.reserve(other.touching.capacity());
        found.reserve_like(other.found);
        impacts.reserve(other.impacts.capacity());
        passed.reserve(other.passed.capacity());
    }
    /// Adds a touching pair whose contacts were added last, from `begin` on.
    void add_touching(const SlotPair& slots, std::size_t begin) {
        touching.push_back({slots, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(found.size())});
    }
    /// Adds the results of other tests.
    void append(const PairResults& other) {
        const auto first = static_cast<std::uint32_t>(found.size());
        for (const auto& [slots, begin, end] : other.touching) touching.push_back({slots, first + begin, first + end});
        found.append(other.found, 0, other.found.size());
        impacts.insert(impacts.end(), other.impacts.begin(), other.impacts.end());
        passed.insert(passed.end(), other.passed.begin(), other.passed.end());
        tested += other.tested;
        balls += other.balls;
    }
};

}  // namespace abut::detail
