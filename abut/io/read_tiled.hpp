#pragma once

// Tiled maps as levels.

#include <abut/io/level.hpp>
#include <abut/io/tiled_files.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <span>

namespace abut {

/// An orthogonal map, as XML or JSON, in pixels, y down: positions are those that Tiled shows.
///
/// A tile layer is one object. A tile takes the room that its tileset's collision editor gives it; where no tileset of
/// the map gives any tile a shape, every tile is full. A layer whose tiles are all full, half, a slope, or one-way (a
/// polyline from corner to corner along an edge) is a TileMap, and of any other a Compound: those tiles as its first
/// child, the shapes of the others as the next ones. Objects are shapes, a tile among them with its tile's shapes, or
/// its whole rectangle; points, and rectangles without extent, are points. Templates are followed. What the editor
/// hides is read all the same. Left out, with a warning: image layers, texts, parallax. Tilesets and templates whose
/// names lead out of the map's folder are a Problem unless they are allowed.
Result<Level> read_tiled(std::span<const std::byte> bytes, tiled::OpenFile open, bool allow_outside);

}  // namespace abut
