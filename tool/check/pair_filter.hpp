#pragma once

// A filter of pairs by name patterns.

#include "tool/shared/name_pattern.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace abut::tool {

/// Two glob patterns, one for each object of a pair.
struct PairPattern {
    std::string a, b;
};

class PairFilter {
public:
    /// Accepts pairs that match a pattern in either order; without patterns, all pairs. Each item has an index, a path
    /// and a name.
    template <class Items>
    PairFilter(const Items& items, const std::vector<PairPattern>& patterns) {
        for (const PairPattern& pattern : patterns) {
            Sides& sides = sides_.emplace_back();
            for (std::size_t i = 0; i < items.size(); ++i) {
                sides.a.push_back(matches_name(pattern.a, items[i]));
                sides.b.push_back(matches_name(pattern.b, items[i]));
            }
        }
    }

    bool has(std::size_t i, std::size_t j) const {
        return sides_.empty() || std::any_of(sides_.begin(), sides_.end(),
                                             [&](const Sides& s) { return (s.a[i] && s.b[j]) || (s.a[j] && s.b[i]); });
    }
    std::uint64_t count(std::size_t items) const {
        std::uint64_t result = items < 2 ? 0 : std::uint64_t{items} * (items - 1) / 2;
        if (sides_.empty()) return result;
        result = 0;
        for (std::size_t i = 0; i < items; ++i)
            for (std::size_t j = i + 1; j < items; ++j) result += has(i, j) ? 1 : 0;
        return result;
    }

private:
    struct Sides {
        std::vector<bool> a, b;
    };
    std::vector<Sides> sides_;
};

}  // namespace abut::tool
