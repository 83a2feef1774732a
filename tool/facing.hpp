#pragma once

// Where two flat pieces face one another.

#include "facet_tree.hpp"

#include <optional>
#include <vector>

namespace abut::tool {

/// All the shortest ways from one convex piece to another are one way, shifted: from A along `across`, `width` long.
template <int D>
struct Facing {
    DVec<D> across{0.0};  ///< of length 1
    double width = 0;
    std::vector<DVec<D>> middles;  ///< the corners of all their middles: a point, the two ends of a segment, a polygon
    DVec<D> centroid{0.0};         ///< of the middles
};

/// Nothing where they aren't farther apart than `least` and nearer than `most`, or touch. Corners closer to a common
/// plane than 1e-4 of the width count as on it.
template <int D>
std::optional<Facing<D>> facing(const FacetShape<D>& a, const FacetShape<D>& b, double least, double most);

}  // namespace abut::tool
