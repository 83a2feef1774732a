#pragma once

// A grid of tiles: level geometry in 2D.

#include <abut/math/result.hpp>
#include <abut/shape/view.hpp>

#include <memory>
#include <span>

namespace abut {

/// What is in a tile. Low and high are ends of an axis, whichever way is up.
enum class Tile : std::uint8_t {
    empty,
    full,
    half_low_x,  ///< the half of the tile at its low x
    half_high_x,
    half_low_y,
    half_high_y,
    slope_low_x_low_y,  ///< the triangle in the corner of low x and low y, cut off by the diagonal
    slope_high_x_low_y,
    slope_low_x_high_y,
    slope_high_x_high_y,
    one_way_low_x,  ///< the edge at low x alone, met from outside the tile: by what comes going along +x
    one_way_high_x,
    one_way_low_y,
    one_way_high_y,
};

/// The union of its tiles, each of them solid but the one-way ones, which are one-sided segments (ChainOptions tells
/// what that means). Tile (column, row) has the number column + row * columns, its part's, and reaches from
/// (column, row) to (column + 1, row + 1), times the size of a cell. Immutable: copies share the data. Memory: the
/// tiles, and about 1.1 bytes for each.
class TileMap {
public:
    /// Rows one after the other, that of low y first. A Problem where there are no tiles, the last row isn't whole, a
    /// tile is none of the kinds (its index), or `cell` isn't above zero or makes a coordinate infinite.
    static Result<TileMap> build(std::span<const Tile> tiles, std::uint32_t columns, const Vec2& cell);
    static Result<TileMap> build(std::span<const Tile> tiles, std::uint32_t columns, float cell);

    std::span<const Tile> tiles() const;
    std::uint32_t columns() const;
    std::uint32_t rows() const;
    Vec2 cell() const;

    std::uint32_t size() const;  ///< of tiles, the empty ones counted
    Tile tile(std::uint32_t index) const { return tiles()[index]; }
    Aabb2 box(std::uint32_t index) const;  ///< of the whole tile

    /// Of the tile without its placement; of an empty one a point in it.
    Convex<2> part(std::uint32_t index) const;

    /// The tile beyond a side, 2 * axis plus one at the low end; no_neighbour where that is empty or outside.
    std::uint32_t neighbour(std::uint32_t tile, std::uint32_t side) const;

private:
    struct Data;
    explicit TileMap(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

    friend Aabb2 bounds(const TileMap& map);
    friend void each_part(const TileMap& map, const Aabb2& box, PartVisitor<2> visit);
    friend void each_part_along(const TileMap& map, const MovingBox<2>& box, PartReachVisitor<2> visit);
    friend void each_part_near(const TileMap& map, const Aabb2& box, PartReachVisitor<2> visit);

    std::shared_ptr<const Data> data_;
};

/// Of all that is not empty, by whole columns and rows; empty where all is.
Aabb2 bounds(const TileMap& map);

/// Visits the tiles that are not empty and whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const TileMap& map, const Aabb2& box, PartVisitor<2> visit);

/// Visits the tiles that are not empty and that the moving box meets, roughly in the order in which it does; the
/// visitor returns the new, shorter reach.
void each_part_along(const TileMap& map, const MovingBox<2>& box, PartReachVisitor<2> visit);

/// Visits the tiles that are not empty, roughly those first that are nearest to `box`; the visitor returns the new,
/// shorter reach.
void each_part_near(const TileMap& map, const Aabb2& box, PartReachVisitor<2> visit);

inline std::uint32_t part_neighbour(const TileMap& map, std::uint32_t part, std::uint32_t side) {
    return map.neighbour(part, side);
}

}  // namespace abut
