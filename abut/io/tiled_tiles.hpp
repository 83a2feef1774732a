#pragma once

// What a tile of a Tiled map is to collisions.

#include <abut/io/level_shape.hpp>
#include <abut/io/tiled_map.hpp>
#include <abut/math/result.hpp>

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace abut::tiled {

/// The shape of an object, or of a piece of a tile, after a map of what the file calls its position. A Problem as
/// `place_line` and its like have it.
Result<PlacedShape> place_object(const Affine<2>& map, const Object& object);

/// A tile that is none of the kinds of a TileMap has shapes of its own.
struct TileLook {
    Tile kind = Tile::empty;
    std::vector<PlacedShape> shapes;  ///< from the low corner of its cell
};

/// The kind of tile that is exactly these shapes in a cell; `empty` where there is none.
Tile kind_of(std::span<const PlacedShape> shapes, const DVec<2>& cell);

/// Finds tiles by their numbers, and works each out once.
class Tiles {
public:
    /// Refers to the map.
    explicit Tiles(const Map& map);

    /// Of a tile in a layer, by its gid with the flips. A Problem where one of its shapes can't be used.
    Result<const TileLook*> look(std::uint32_t gid);

    /// The shapes of a tile that is shown as an object of this size; its rectangle where it has none. `map` takes the
    /// rectangle from the origin to `size` to where it is.
    Result<std::vector<PlacedShape>> shown(std::uint32_t gid, const DVec<2>& size, const Affine<2>& map) const;

    const Tileset* tileset_of(std::uint32_t gid) const;
    const TileData* tile_of(std::uint32_t gid) const;
    /// Whether any tile of the map has a shape of its own; where none has, all are full.
    bool have_shapes() const { return have_shapes_; }

private:
    DVec<2> size_of(std::uint32_t gid) const;
    Result<TileLook> work_out(std::uint32_t gid) const;

    const Map& map_;
    bool have_shapes_ = false;
    std::unordered_map<std::uint32_t, TileLook> looks_;
};

}  // namespace abut::tiled
