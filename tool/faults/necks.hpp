#pragma once

// Finds necks: local minima of the distance between surfaces. gaps.hpp defines them.

#include "tool/faults/facet_gap.hpp"
#include "tool/faults/gaps.hpp"

#include <array>
#include <vector>

namespace abut::tool {

using detail::DVec;

template <int D>
struct Neck {
    std::size_t a = 0, b = 0;  ///< objects, the first at the start of `across`
    DVec<D> across{0.0};       ///< unit vector
    double width = 0;
    DVec<D> middle{0.0};
    /// Perpendicular to `across` and to one another: principal axes of the midpoints of all translated necks.
    std::array<DVec<D>, static_cast<std::size_t>(D) - 1> along{};
    bool is_detour = false;  ///< as in Gap
};

/// All necks, in facet order.
template <int D>
std::vector<Neck<D>> find_necks(const FacetTree<D>& facets, const GapOptions<D>& options);

}  // namespace abut::tool
