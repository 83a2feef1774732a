#pragma once

// A tree over boxes that lie in a good order already: each node is around eight neighbours. Not for users.

#include <abut/broad_phase/box_sides.hpp>
#include <abut/math/aabb.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// Where in a row of boxes, and in a row of nodes, a tree lies. Level 0 are the boxes themselves.
struct BoxRuns {
    static constexpr std::uint32_t width = 8;  ///< boxes or nodes below a node; the last of a level may have fewer
    static constexpr int most_levels = 12;     ///< enough for 2^33 boxes

    std::uint32_t count = 0;
    int levels = 0;                                  ///< the highest has one node; 0 where there is no box
    std::array<std::uint32_t, most_levels> first{};  ///< of each level

    std::uint32_t count_at(int level) const {
        std::uint32_t result = count;
        for (; level > 0; --level) result = (result + width - 1) / width;
        return result;
    }
};

/// The least box that holds these, of which there is one at least.
template <int D>
Aabb<D> around(const Aabb<D>* begin, const Aabb<D>* end) {
    BoxSides<D> result = BoxSides<D>::of(*begin);
    for (const Aabb<D>* box = begin + 1; box != end; ++box) result.take_in(BoxSides<D>::of(*box));
    return result.box();
}

/// The tree over `count` boxes from `first` on. Its nodes are added to the row of nodes.
template <int D>
BoxRuns build_runs(const std::vector<Aabb<D>>& boxes, std::uint32_t first, std::uint32_t count,
                   std::vector<Aabb<D>>& nodes) {
    BoxRuns result;
    result.count = count;
    if (count == 0) return result;
    result.first[0] = first;
    result.levels = 1;
    for (std::uint32_t below = count; below > 1; ++result.levels) {
        const auto level = static_cast<std::size_t>(result.levels);
        const Aabb<D>* from = level == 1 ? boxes.data() + first : nullptr;
        result.first[level] = static_cast<std::uint32_t>(nodes.size());
        for (std::uint32_t begin = 0; begin < below; begin += BoxRuns::width) {
            if (level > 1) from = nodes.data() + result.first[level - 1];
            const std::uint32_t end = std::min(begin + BoxRuns::width, below);
            nodes.push_back(around(from + begin, from + end));
        }
        below = (below + BoxRuns::width - 1) / BoxRuns::width;
    }
    return result;
}

}  // namespace abut
