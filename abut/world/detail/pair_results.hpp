#pragma once

// What the tests of pairs find in an update.

#include <abut/world/detail/found_contacts.hpp>

namespace abut::detail {

/// In the order of the pairs that were tested.
template <int D>
struct PairResults {
    std::vector<IdPair> touching;
    FoundContacts<D> found;
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
    /// Appends the results of later pairs.
    void append(const PairResults& later) {
        touching.insert(touching.end(), later.touching.begin(), later.touching.end());
        found.append(later.found);
        impacts.insert(impacts.end(), later.impacts.begin(), later.impacts.end());
        passed.insert(passed.end(), later.passed.begin(), later.passed.end());
        tested += later.tested;
        balls += later.balls;
    }
};

}  // namespace abut::detail
