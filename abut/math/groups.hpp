#pragma once

// Things that belong together, pair by pair.

#include <cstddef>
#include <numeric>
#include <vector>

namespace abut {

/// 0..n-1, each at first in a group of its own.
class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

    void join(std::size_t a, std::size_t b) {
        a = lowest(a);
        b = lowest(b);
        (a < b ? parent_[b] : parent_[a]) = a < b ? a : b;
    }

    /// The lowest of the group.
    std::size_t lowest(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// Those of more than one, or all of them; each in order, and in the order of their lowest.
    std::vector<std::vector<std::size_t>> all(std::size_t least_size = 1) {
        std::vector<std::vector<std::size_t>> members(parent_.size()), result;
        for (std::size_t i = 0; i < parent_.size(); ++i) members[lowest(i)].push_back(i);
        for (std::vector<std::size_t>& group : members)
            if (!group.empty() && group.size() >= least_size) result.push_back(std::move(group));
        return result;
    }

private:
    std::vector<std::size_t> parent_;
};

}  // namespace abut
