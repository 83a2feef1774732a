#pragma once

// The broad phase: selected pairs whose boxes overlap.

#include "tool/check/pair_filter.hpp"
#include "tool/check/piles.hpp"
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

/// Limit of pairs per frame: they take a quarter of a gigabyte, and about a minute.
inline constexpr std::size_t max_pairs_at_once = std::size_t{1} << 22;

template <int D>
class OverlappingPairs {
public:
    explicit OverlappingPairs(const PairFilter& selection, std::size_t max_pairs = max_pairs_at_once)
        : filter_(selection), max_pairs_(max_pairs) {}

    /// Finds all pairs but those of one pile. The number of boxes must not change between calls. Piles are found with
    /// `find_piles`, which is called if there are many pairs.
    template <class FindPiles>
    std::optional<Problem> find(std::span<const Aabb<D>> boxes, Piles<D>& piles, FindPiles find_piles) {
        piles.clear();
        if (std::optional<Problem> problem = find_up_to(std::min(many_pairs, max_pairs_), boxes, piles); !problem)
            return problem;
        find_piles();
        return find_up_to(max_pairs_, boxes, piles);
    }

    /// Finds all pairs but those of one pile.
    std::optional<Problem> find(std::span<const Aabb<D>> boxes, const Piles<D>& piles) {
        return find_up_to(max_pairs_, boxes, piles);
    }

    /// Sorted.
    const std::vector<Pair>& pairs() const { return pairs_; }

private:
    /// Above this number piles are sought.
    static constexpr std::size_t many_pairs = std::size_t{1} << 16;

    std::optional<Problem> find_up_to(std::size_t max_pairs, std::span<const Aabb<D>> boxes, const Piles<D>& piles) {
        if (is_built_)
            tree_.update(boxes);
        else
            tree_.build(boxes);
        is_built_ = true;
        pairs_.clear();
        tree_.each_pair([&](std::uint32_t i, std::uint32_t j) {
            if (!piles.has(i, j) && filter_.has(i, j)) pairs_.emplace_back(std::min(i, j), std::max(i, j));
            return pairs_.size() <= max_pairs;
        });
        if (pairs_.size() > max_pairs)
            return Problem{ProblemCode::too_large, "more than " + std::to_string(max_pairs) +
                                                       " pairs of objects overlap, the limit: --pairs selects fewer"};
        std::sort(pairs_.begin(), pairs_.end());
        return std::nullopt;
    }

    const PairFilter& filter_;
    std::size_t max_pairs_;
    bool is_built_ = false;
    Bvh<D> tree_;
    std::vector<Pair> pairs_;
};

}  // namespace abut::tool
