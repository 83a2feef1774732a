#pragma once

// The broad phase: selected pairs whose boxes overlap.

#include "tool/check/pair_filter.hpp"
#include <abut/abut.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace abut::tool {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Limit of pairs per frame: they take about one gigabyte.
inline constexpr std::size_t max_pairs_at_once = std::size_t{1} << 24;

template <int D>
class OverlappingPairs {
public:
    explicit OverlappingPairs(const PairFilter& selection, std::size_t max_pairs = max_pairs_at_once)
        : filter_(selection), max_pairs_(max_pairs) {}

    /// Finds all pairs. The number of boxes must not change between calls.
    std::optional<Problem> find(std::span<const Aabb<D>> boxes) {
        if (is_built_)
            tree_.update(boxes);
        else
            tree_.build(boxes);
        is_built_ = true;
        pairs_.clear();
        tree_.each_pair([&](std::uint32_t i, std::uint32_t j) {
            if (filter_.has(i, j)) pairs_.emplace_back(std::min(i, j), std::max(i, j));
            return pairs_.size() <= max_pairs_;
        });
        if (pairs_.size() > max_pairs_)
            return Problem{ProblemCode::too_large, "more than " + std::to_string(max_pairs_) +
                                                       " pairs of objects overlap: --pairs selects fewer"};
        std::sort(pairs_.begin(), pairs_.end());
        return std::nullopt;
    }

    /// Sorted.
    const std::vector<Pair>& pairs() const { return pairs_; }

private:
    const PairFilter& filter_;
    std::size_t max_pairs_;
    bool is_built_ = false;
    Bvh<D> tree_;
    std::vector<Pair> pairs_;
};

}  // namespace abut::tool
