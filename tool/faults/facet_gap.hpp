#pragma once

// The shortest connections of two facets.

#include "tool/faults/facet_tree.hpp"

#include <optional>
#include <vector>

namespace abut::tool {

using detail::DVec;

/// The set of all shortest segments between two convex facets. They are translates of one segment: from A along
/// `across`, `width` long.
template <int D>
struct FacetGap {
    DVec<D> across{0.0};  ///< unit vector from A to B
    double width = 0;
    std::vector<DVec<D>> midpoints;  ///< vertices of the set of their midpoints: a point, a segment or a convex polygon
    DVec<D> centroid{0.0};           ///< centroid of the midpoints
};

/// Returns nothing unless `min_width` < distance < `max_width` and the facets don't touch. Vertices closer to a common
/// plane than 1e-4 of the width count as in it.
template <int D>
std::optional<FacetGap<D>> facet_gap(const FacetShape<D>& a, const FacetShape<D>& b, double min_width,
                                     double max_width);

}  // namespace abut::tool
