#pragma once

// The pairs whose boxes overlap, as far as they are asked about.

#include "selection.hpp"
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

/// So many pairs at once take about a gigabyte; beyond it is a Problem.
inline constexpr std::size_t max_pairs_at_once = std::size_t{1} << 24;

template <int D>
class NearPairs {
public:
    explicit NearPairs(const Selection& selection, std::size_t max_pairs = max_pairs_at_once)
        : selection_(selection), max_pairs_(max_pairs) {}

    /// Finds them anew, for as many boxes as before.
    std::optional<Problem> find(std::span<const Aabb<D>> boxes) {
        if (is_built_)
            tree_.update(boxes);
        else
            tree_.build(boxes);
        is_built_ = true;
        pairs_.clear();
        tree_.each_pair([&](std::uint32_t i, std::uint32_t j) {
            if (selection_.has(i, j)) pairs_.emplace_back(std::min(i, j), std::max(i, j));
            return pairs_.size() <= max_pairs_;
        });
        if (pairs_.size() > max_pairs_)
            return Problem{ProblemCode::too_large, "more than " + std::to_string(max_pairs_) +
                                                       " pairs of objects are in one place: --pairs asks about fewer"};
        std::sort(pairs_.begin(), pairs_.end());
        return std::nullopt;
    }

    /// Sorted.
    const std::vector<Pair>& pairs() const { return pairs_; }

private:
    const Selection& selection_;
    std::size_t max_pairs_;
    bool is_built_ = false;
    Bvh<D> tree_;
    std::vector<Pair> pairs_;
};

}  // namespace abut::tool
