#pragma once

// What bounds a shape of the plane, as segments.

#include "level_view.hpp"
#include <abut/shape/view.hpp>

namespace abut::tool {

/// The outline of all its parts together: their edges, cut where they cross, without what has the shape on both sides,
/// such as between two full tiles. Lines are two-sided; `filled` says that parts have areas, or closed lines go around
/// something as in LevelObject: what these go around is behind them. Curved parts count as the polygons within them
/// that they are no farther from than 1e-4 of their extent.
///
/// What is on a side is looked at beside the middle of each piece, a thousandth of its length away: what is thinner
/// than that may be taken for nothing. O(n log n), and for each piece what `contains` takes.
Surface<2> surface_of(const View<2>& shape, bool filled);

}  // namespace abut::tool
