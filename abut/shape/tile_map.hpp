#pragma once

// Tile map: level geometry in 2D on a regular grid.

#include <abut/math/result.hpp>
#include <abut/shape/detail/changed_box.hpp>
#include <abut/shape/view/view.hpp>

#include <memory>
#include <span>

namespace abut {

/// The shape of a tile. Low and high are the ends of an axis.
enum class Tile : std::uint8_t {
    empty,
    full,
    half_low_x,  ///< the half of the tile at its low x
    half_high_x,
    half_low_y,
    half_high_y,
    slope_low_x_low_y,  ///< the triangle at the corner of low x and low y, bounded by the diagonal
    slope_high_x_low_y,
    slope_low_x_high_y,
    slope_high_x_high_y,
    one_way_low_x,  ///< only the edge at low x; it stops motion along +x that comes from outside the tile
    one_way_high_x,
    one_way_low_y,
    one_way_high_y,
};

/// The union of its tiles. All tiles are solid except the one-way tiles, which are one-sided segments (see
/// ChainOptions). Tile (column, row) is part column + row * columns and covers (column, row) to (column + 1, row + 1),
/// times the cell size. Copies share the data until one of them changes. Memory: the tiles, and about 1.1 bytes for
/// each.
class TileMap {
public:
    /// Takes the tiles row by row, from low y. Returns a Problem if there are no tiles, if the last row is incomplete,
    /// if a tile has an unknown kind (index: the tile), or if `cell` isn't positive or makes a coordinate infinite.
    static Result<TileMap> build(std::span<const Tile> tiles, std::uint32_t columns, const Vec2& cell);
    static Result<TileMap> build(std::span<const Tile> tiles, std::uint32_t columns, float cell);

    /// Replaces a tile. All answers are those of a map that is built with it. It takes well under a microsecond, and
    /// the time of a copy if another map shares the data. In a World: World::edit_shape.
    void set(std::uint32_t index, Tile tile);

    std::span<const Tile> tiles() const;
    std::uint32_t columns() const;
    std::uint32_t rows() const;
    Vec2 cell() const;

    std::uint32_t size() const;  ///< number of tiles, including empty ones
    Tile tile(std::uint32_t index) const { return tiles()[index]; }
    Aabb2 box(std::uint32_t index) const;  ///< the box of the whole cell

    /// The shape of the tile in the map's frame; for an empty tile a point in it.
    detail::Convex<2> part(std::uint32_t index) const;

    /// The adjacent tile across side 2 * axis (high end) or 2 * axis + 1 (low end); no_neighbour if it is empty or
    /// outside.
    std::uint32_t neighbour(std::uint32_t tile, std::uint32_t side) const;

private:
    struct Data;
    explicit TileMap(std::shared_ptr<Data> data) : data_(std::move(data)) {}

    friend Aabb2 bounds(const TileMap& map);
    friend Aabb2 take_changed(TileMap& map);
    friend void each_part(const TileMap& map, const Aabb2& box, detail::PartVisitor<2> visit);
    friend void each_part_along(const TileMap& map, const MovingBox<2>& box, detail::PartReachVisitor<2> visit);
    friend void each_part_near(const TileMap& map, const Aabb2& box, detail::PartReachVisitor<2> visit);

    std::shared_ptr<Data> data_;  // of this map alone before it changes
    detail::ChangedBox<2> changed_;
};

/// The box around all non-empty tiles; empty if there are none.
Aabb2 bounds(const TileMap& map);

/// The box outside of which no answer has changed since the last call, for World::edit_shape.
Aabb2 take_changed(TileMap& map);

/// Visits the non-empty tiles whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const TileMap& map, const Aabb2& box, detail::PartVisitor<2> visit);

/// Visits the non-empty tiles that the moving box overlaps, roughly front to back. The visitor returns the new, shorter
/// reach.
void each_part_along(const TileMap& map, const MovingBox<2>& box, detail::PartReachVisitor<2> visit);

/// Visits the non-empty tiles, roughly nearest first by the distance to `box`. The visitor returns the new, shorter
/// reach.
void each_part_near(const TileMap& map, const Aabb2& box, detail::PartReachVisitor<2> visit);

inline std::uint32_t part_neighbour(const TileMap& map, std::uint32_t part, std::uint32_t side) {
    return map.neighbour(part, side);
}

namespace detail {

template <>
inline constexpr CompositeKind composite_kind<TileMap> = CompositeKind::tile_map;

}  // namespace detail

}  // namespace abut
