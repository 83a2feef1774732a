#pragma once

// Near pairs, and what their tests find in an update.

#include <abut/world/detail/found_contacts.hpp>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace abut::detail {

/// The slots of two near items, the lower one first.
struct SlotPair {
    std::uint32_t a = 0, b = 0;

    friend auto operator<=>(const SlotPair&, const SlotPair&) = default;
};

/// In the order of the pairs that were tested, or sorted by pairs.
template <int D>
struct PairResults {
    std::vector<IdPair> touching;
    FoundContacts<D> found;               ///< of the touching pairs
    std::vector<std::size_t> found_end;   ///< by index in touching: of its contacts, which begin where the last ended
    std::vector<WorldImpact<D>> impacts;  ///< of continuous pairs that didn't touch at the last update
    std::vector<IdPair> passed;           ///< pairs with an impact that don't touch at the end
    std::size_t tested = 0, balls = 0;    ///< see UpdateCounts

    void clear() {
        touching.clear();
        found_end.clear();
        found.clear();
        impacts.clear();
        passed.clear();
        tested = balls = 0;
    }
    /// The contacts of touching pair `i`, by their indices.
    std::pair<std::size_t, std::size_t> found_of(std::size_t i) const {
        return {i == 0 ? 0 : found_end[i - 1], found_end[i]};
    }
    /// For the results of this many pairs without parts.
    void reserve(std::size_t pairs) {
        touching.reserve(pairs);
        found_end.reserve(pairs);
        found.reserve(pairs);
    }
    /// Adds a touching pair whose contacts were added last.
    void add_touching(const IdPair& pair) {
        touching.push_back(pair);
        found_end.push_back(found.size());
    }
    /// Adds the contacts of touching pair `i` of a list.
    void add_found(const PairResults& from, std::size_t i) {
        const auto [begin, end] = from.found_of(i);
        found.append(from.found, begin, end);
    }
    /// Adds what isn't of touching pairs.
    void add_others(const PairResults& from) {
        impacts.insert(impacts.end(), from.impacts.begin(), from.impacts.end());
        passed.insert(passed.end(), from.passed.begin(), from.passed.end());
        tested += from.tested;
        balls += from.balls;
    }
    /// Sorts what isn't of touching pairs.
    void sort_others() {
        std::sort(impacts.begin(), impacts.end(), [](const WorldImpact<D>& first, const WorldImpact<D>& second) {
            return IdPair{first.a, first.b} < IdPair{second.a, second.b};
        });
        std::sort(passed.begin(), passed.end());
    }
};

}  // namespace abut::detail
