#pragma once

// Where free space is narrowest between two pieces of surface. What a neck is, gaps.hpp tells.

#include "facing.hpp"
#include "gaps.hpp"

#include <array>
#include <vector>

namespace abut::tool {

template <int D>
struct Neck {
    std::size_t a = 0, b = 0;  ///< objects, the first at the start of `across`
    DVec<D> across{0.0};       ///< of length 1
    double width = 0;
    DVec<D> middle{0.0};
    /// At right angles to `across` and to one another: along which the necks that are shifts of this one go farthest.
    std::array<DVec<D>, static_cast<std::size_t>(D) - 1> along{};
};

/// All of them, in the order of the facets.
template <int D>
std::vector<Neck<D>> find_necks(const FacetTree<D>& facets, const GapOptions<D>& options);

}  // namespace abut::tool
