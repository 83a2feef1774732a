#pragma once

// The boundary of a 2D shape as segments.

#include "tool/objects/level_view.hpp"
#include <abut/shape/view/view.hpp>

namespace abut::tool {

/// The boundary of the union of all parts: their edges, split at intersections, without those that have the shape on
/// both sides, such as edges between two full tiles. Lines are two-sided. `filled`: parts have areas, or closed lines
/// enclose an area as in LevelObject, which is behind them. Curved parts are approximated by inscribed polygons to
/// within 1e-4 of their extent. The side test samples the shape beside the midpoint of each segment at a distance of
/// 1e-3 of its length; thinner features may be missed. Takes O(n log n) time, plus one `contains` per segment.
Surface<2> surface_of(const View<2>& shape, bool filled);

}  // namespace abut::tool
