#pragma once

// What bounds a shape of the plane, as segments.

#include "level_view.hpp"
#include <abut/shape/view.hpp>

namespace abut::tool {

/// The edges of all its parts, but those that have the shape on both sides, such as between two full tiles. Lines are
/// two-sided; `filled` says that closed ones go around something, as in LevelObject, and then they have it behind them.
/// Curved parts count as the polygons within them that they are no farther from than 1e-4 of their extent.
///
/// What is on a side of an edge is looked at beside it, a thousandth of its length away: an edge that is only in part
/// inside of the shape is kept whole.
Surface<2> surface_of(const View<2>& shape, bool filled);

}  // namespace abut::tool
