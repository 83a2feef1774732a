#pragma once

// Collision shapes of Tiled's tiles.

#include <abut/io/level_shape.hpp>
#include <abut/io/tiled/map.hpp>
#include <abut/math/result.hpp>

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace abut::tiled {

/// The shape of an object, or of a collision shape of a tile, under an affine map of its file coordinates. The Problems
/// are those of `place_polyline`.
Result<detail::PlacedShape> place_object(const detail::Affine<2>& map, const Object& object);

/// The collision of a tile: a tile kind of TileMap, or else its own shapes.
struct TileCollision {
    Tile kind = Tile::empty;
    std::vector<detail::PlacedShape> shapes;  ///< relative to the low corner of its cell
};

/// The tile kind whose shape equals these shapes in a cell; `empty` if there is none.
Tile kind_of(std::span<const detail::PlacedShape> shapes, const detail::DVec<2>& cell);

/// Looks up tiles by gid and caches their collision shapes.
class Tiles {
public:
    /// Refers to the map.
    explicit Tiles(const Map& map);

    /// The collision of a tile in a layer, by its gid with flip flags. Returns a Problem if one of its shapes is
    /// invalid.
    Result<const TileCollision*> collision(std::uint32_t gid);

    /// The shapes of a tile object of this size; its rectangle if the tile has none. `map` places the rectangle from
    /// the origin to `size`.
    Result<std::vector<detail::PlacedShape>> shown(std::uint32_t gid, const detail::DVec<2>& size,
                                                   const detail::Affine<2>& map) const;

    const Tileset* tileset_of(std::uint32_t gid) const;
    const TileData* tile_of(std::uint32_t gid) const;
    /// True if any tile of the map has a collision shape; if none has, all tiles are full.
    bool have_shapes() const { return have_shapes_; }

private:
    detail::DVec<2> size_of(std::uint32_t gid) const;
    Result<TileCollision> compute_collision(std::uint32_t gid) const;
    bool is_hexagonal() const { return map_.stagger && map_.stagger->side > 0; }

    const Map& map_;
    bool have_shapes_ = false;
    std::unordered_map<std::uint32_t, TileCollision> collisions_;
};

}  // namespace abut::tiled
