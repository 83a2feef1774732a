#pragma once

// The boundary of a 2D shape as segments.

#include "tool/objects/level_view.hpp"
#include <abut/math/result.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/view/view.hpp>

#include <cstddef>

namespace abut::tool {

/// The boundary of the union of all parts: their edges, split at intersections, without those that have the shape on
/// both sides, such as edges between two full tiles. Lines are two-sided. `filled`: parts have areas, or closed lines
/// enclose an area as in LevelObject, which is behind them. Curved parts are approximated by inscribed polygons to
/// within 1e-4 of their extent. The side test samples the shape beside the midpoint of each segment at a distance of
/// 1e-3 of its length; thinner features may be missed. Takes O(n log n) time, plus one `contains` per segment. Edges
/// between full tiles of `tiles`, if that is the shape, take no memory. Returns a Problem (`too_large`) beyond the
/// limits below; its message says nothing about the object.
Result<Surface<2>> surface_of(const View<2>& shape, bool filled, const TileMap* tiles = nullptr);

inline constexpr std::size_t max_outline_edges = std::size_t{1} << 22;
/// Of the edges of one object, each pair once.
inline constexpr std::size_t max_outline_crossings = std::size_t{1} << 16;

}  // namespace abut::tool
