#pragma once

// A filter of pairs by name patterns.

#include "tool/shared/name_pattern.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace abut::tool {

/// Two glob patterns, one for each object of a pair.
struct PairPattern {
    std::string a, b;
};

class PairFilter {
public:
    /// Accepts pairs that match a pattern in either order; without patterns, all pairs. Each item has an index, a path,
    /// a name and a class. Pairs with equal numbers in `bodies` are not accepted; empty: all are different.
    template <class Items>
    PairFilter(const Items& items, const std::vector<PairPattern>& patterns, std::vector<std::uint32_t> bodies = {})
        : bodies_(std::move(bodies)) {
        for (const PairPattern& pattern : patterns) {
            Sides& sides = sides_.emplace_back();
            for (std::size_t i = 0; i < items.size(); ++i) {
                sides.a.push_back(matches_name(pattern.a, items[i]));
                sides.b.push_back(matches_name(pattern.b, items[i]));
            }
        }
    }

    bool has(std::size_t i, std::size_t j) const {
        if (!bodies_.empty() && bodies_[i] == bodies_[j]) return false;
        return sides_.empty() || std::any_of(sides_.begin(), sides_.end(),
                                             [&](const Sides& s) { return (s.a[i] && s.b[j]) || (s.a[j] && s.b[i]); });
    }
    /// True if no pair is left out.
    bool has_all_pairs() const { return sides_.empty() && (bodies_.empty() || count_within_bodies() == 0); }
    std::uint64_t count(std::size_t items) const {
        if (sides_.empty()) return pairs_of(items) - count_within_bodies();
        std::uint64_t result = 0;
        for (std::size_t i = 0; i < items; ++i)
            for (std::size_t j = i + 1; j < items; ++j) result += has(i, j) ? 1 : 0;
        return result;
    }

private:
    struct Sides {
        std::vector<bool> a, b;
    };

    static std::uint64_t pairs_of(std::uint64_t items) { return items < 2 ? 0 : items * (items - 1) / 2; }
    std::uint64_t count_within_bodies() const {
        std::map<std::uint32_t, std::uint64_t> sizes;
        for (const std::uint32_t body : bodies_) ++sizes[body];
        std::uint64_t result = 0;
        for (const auto& [body, size] : sizes) result += pairs_of(size);
        return result;
    }

    std::vector<std::uint32_t> bodies_;
    std::vector<Sides> sides_;
};

}  // namespace abut::tool
