#pragma once

// The intersection of two polygons of few edges: the smaller one is cut with the edge lines of the larger one, on the
// stack.

#include <abut/convex/pairs/placed_polygon2.hpp>

namespace abut::detail {

/// Corners in the world, counter-clockwise; some may coincide or be collinear.
struct ClippedLoop {
    std::array<DVec<2>, std::size_t{2} * max_soa_edges> points;
    std::size_t count = 0;
};

/// Both have rows. Returns false if one of them has almost no area, which takes the general algorithm. Corners of the
/// polygon that is cut stay in place; a corner within rounding of a line lies on it.
bool clip_polygons(const PlacedPolygon& a, const PlacedPolygon& b, ClippedLoop& loop);

}  // namespace abut::detail
