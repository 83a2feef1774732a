#pragma once

// The pairs of things that somebody asks about, by patterns for their names.

#include "glob.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace abut::tool {

/// Two patterns for names, one for each side of a pair.
struct PairPattern {
    std::string a, b;
};

class Selection {
public:
    /// Pairs of which one of the patterns describes both sides, either way round; without patterns all pairs. The
    /// things have a number, a path and a name each.
    template <class Things>
    Selection(const Things& things, const std::vector<PairPattern>& patterns) {
        for (const PairPattern& pattern : patterns) {
            Sides& sides = sides_.emplace_back();
            for (std::size_t i = 0; i < things.size(); ++i) {
                sides.a.push_back(describes(pattern.a, things[i]));
                sides.b.push_back(describes(pattern.b, things[i]));
            }
        }
    }

    bool has(std::size_t i, std::size_t j) const {
        return sides_.empty() || std::any_of(sides_.begin(), sides_.end(),
                                             [&](const Sides& s) { return (s.a[i] && s.b[j]) || (s.a[j] && s.b[i]); });
    }
    std::uint64_t count(std::size_t things) const {
        std::uint64_t result = things < 2 ? 0 : std::uint64_t{things} * (things - 1) / 2;
        if (sides_.empty()) return result;
        result = 0;
        for (std::size_t i = 0; i < things; ++i)
            for (std::size_t j = i + 1; j < things; ++j) result += has(i, j) ? 1 : 0;
        return result;
    }

private:
    struct Sides {
        std::vector<bool> a, b;
    };
    std::vector<Sides> sides_;
};

}  // namespace abut::tool
