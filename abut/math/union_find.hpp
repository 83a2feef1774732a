#pragma once

// Union-find (disjoint sets), for connected components.

#include <cstddef>
#include <numeric>
#include <vector>

namespace abut::detail {

/// Disjoint sets of 0..n-1; each element starts as a set of its own.
class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }

    void unite(std::size_t a, std::size_t b) {
        a = find(a);
        b = find(b);
        (a < b ? parent_[b] : parent_[a]) = a < b ? a : b;
    }

    /// The lowest element of the set, with path halving.
    std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// The sets of at least `min_size` elements. Elements are in ascending order, and so are the sets by their lowest
    /// element.
    std::vector<std::vector<std::size_t>> all(std::size_t min_size = 1) {
        std::vector<std::vector<std::size_t>> members(parent_.size()), result;
        for (std::size_t i = 0; i < parent_.size(); ++i) members[find(i)].push_back(i);
        for (std::vector<std::size_t>& group : members)
            if (!group.empty() && group.size() >= min_size) result.push_back(std::move(group));
        return result;
    }

private:
    std::vector<std::size_t> parent_;
};

}  // namespace abut::detail
