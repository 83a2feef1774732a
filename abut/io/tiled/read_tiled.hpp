#pragma once

// Reads Tiled maps as levels.

#include <abut/io/level.hpp>
#include <abut/io/tiled/files.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <span>

namespace abut::detail {

/// Reads a map, XML or JSON, in pixels with y down: positions equal those that Tiled shows. An isometric map is read on
/// the ground. A full tile of a staggered or hexagonal map is a Polygon.
/// A tile layer is one object. A tile has the shapes of its tileset's collision editor; if no tileset has collision
/// shapes, every tile is full. A layer of full, half, slope and one-way tiles (a polyline between corners along an
/// edge) is a TileMap. Any other layer is a Compound: that TileMap as its first child, then the shapes of the other
/// tiles. Objects are shapes. A tile object has its tile's shapes, or its rectangle if it has none. Points and
/// rectangles without extent are points. Templates are resolved. Hidden layers are read too. Image layers, texts and
/// parallax are left out with a warning. Returns a Problem for tilesets and templates outside of the map's folder
/// unless they are allowed.
Result<Level> read_tiled(std::span<const std::byte> bytes, tiled::OpenFile open, bool allow_outside);

}  // namespace abut::detail
