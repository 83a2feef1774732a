#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/detail/grid_hierarchy.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/triangle.hpp>

#include <vector>

namespace abut {

using namespace detail;

namespace {

/// The range of columns and rows in a block that hold non-empty tiles.
struct OccupiedRange {
    std::uint32_t first_column = 0xffffffffu, first_row = 0xffffffffu, end_column = 0, end_row = 0;

    bool any() const { return first_column < end_column; }
};
OccupiedRange merged(const OccupiedRange& a, const OccupiedRange& b) {
    return {std::min(a.first_column, b.first_column), std::min(a.first_row, b.first_row),
            std::max(a.end_column, b.end_column), std::max(a.end_row, b.end_row)};
}

Convex<2> one_way_edge(const Vec2& from, const Vec2& to) {
    Convex<2> result = convex(Segment2{from, to});
    result.one_sided = true;
    return result;
}

Convex<2> tile_shape(Tile tile, const Aabb2& box) {
    const Vec2 low = box.min, high = box.max, low_high(low.x, high.y), high_low(high.x, low.y);
    const Vec2 middle = center(box);
    switch (tile) {
        case Tile::empty:
            return round_points<2>({middle}, 0);
        case Tile::full:
            return convex(box);
        case Tile::half_low_x:
            return convex(Aabb2{low, {middle.x, high.y}});
        case Tile::half_high_x:
            return convex(Aabb2{{middle.x, low.y}, high});
        case Tile::half_low_y:
            return convex(Aabb2{low, {high.x, middle.y}});
        case Tile::half_high_y:
            return convex(Aabb2{{low.x, middle.y}, high});
        case Tile::slope_low_x_low_y:
            return convex(Triangle2{low, high_low, low_high});
        case Tile::slope_high_x_low_y:
            return convex(Triangle2{high_low, high, low});
        case Tile::slope_low_x_high_y:
            return convex(Triangle2{low_high, low, high});
        case Tile::slope_high_x_high_y:
            return convex(Triangle2{high, low_high, high_low});
        // The front of a segment is on the right of its direction.
        case Tile::one_way_low_x:
            return one_way_edge(low_high, low);
        case Tile::one_way_high_x:
            return one_way_edge(high_low, high);
        case Tile::one_way_low_y:
            return one_way_edge(low, high_low);
        case Tile::one_way_high_y:
            return one_way_edge(high, low_high);
    }
    return round_points<2>({middle}, 0);
}

}  // namespace

struct TileMap::Data {
    std::vector<Tile> tiles;
    std::uint32_t columns = 0, rows = 0;
    Vec2 cell{};
    GridHierarchy<OccupiedRange> blocks;

    Aabb2 box_of(std::uint32_t first_column, std::uint32_t first_row, std::uint32_t end_column,
                 std::uint32_t end_row) const {
        return {{static_cast<float>(first_column) * cell.x, static_cast<float>(first_row) * cell.y},
                {static_cast<float>(end_column) * cell.x, static_cast<float>(end_row) * cell.y}};
    }
    Aabb2 box_of(const OccupiedRange& filled) const {
        return filled.any() ? box_of(filled.first_column, filled.first_row, filled.end_column, filled.end_row)
                            : Aabb2::empty();
    }
    OccupiedRange of_tile(std::uint32_t x, std::uint32_t y) const {
        return tiles[x + y * columns] == Tile::empty ? OccupiedRange() : OccupiedRange{x, y, x + 1, y + 1};
    }
    Aabb2 box_of_tile(std::uint32_t x, std::uint32_t y) const { return box_of(x, y, x + 1, y + 1); }

    /// Calls visit(part, index) for the tiles within reach; it returns the new reach.
    template <class Reach, class Visit>
    void each_within(Reach reach, Visit&& visit) const {
        const auto box_of_block = [this](std::uint32_t level, std::uint32_t x, std::uint32_t y) {
            return box_of(level == 0 ? of_tile(x, y) : blocks.at(level, x, y));
        };
        blocks.traverse(reach, box_of_block, [&](std::uint32_t x, std::uint32_t y) {
            const std::uint32_t index = x + y * columns;
            reach.shrink(visit(tile_shape(tiles[index], box_of_tile(x, y)), index));
        });
    }
};

Result<TileMap> TileMap::build(std::span<const Tile> tiles, std::uint32_t columns, const Vec2& cell) {
    detail::enter_library();
    if (tiles.empty()) return Problem{ProblemCode::empty_input, "a tile map needs tiles", 0};
    if (columns == 0 || tiles.size() % columns != 0)
        return Problem{
            ProblemCode::bad_argument,
            std::to_string(tiles.size()) + " tiles are no whole number of rows of " + std::to_string(columns), 0};
    constexpr std::size_t max_tiles = std::size_t{1} << 31;
    if (tiles.size() > max_tiles)
        return Problem{ProblemCode::too_large, "a tile map has at most 2^31 tiles", max_tiles};
    for (std::size_t i = 0; i < tiles.size(); ++i)
        if (tiles[i] > Tile::one_way_high_y)
            return Problem{ProblemCode::bad_argument,
                           "tile " + std::to_string(i) +
                               " is of no kind that there is: " + std::to_string(static_cast<int>(tiles[i])),
                           i};
    auto data = std::make_shared<Data>();
    data->tiles.assign(tiles.begin(), tiles.end());
    data->columns = columns;
    data->rows = static_cast<std::uint32_t>(tiles.size() / columns);
    data->cell = cell;
    if (!(cell.x > 0 && cell.y > 0 && is_finite(data->box_of(0, 0, columns, data->rows).max)))
        return Problem{ProblemCode::bad_argument, "the cells' sizes must be above zero, and their places finite", 0};
    data->blocks.build(columns, data->rows, [&](std::uint32_t x, std::uint32_t y) { return data->of_tile(x, y); });
    return TileMap(std::move(data));
}

Result<TileMap> TileMap::build(std::span<const Tile> tiles, std::uint32_t columns, float cell) {
    detail::enter_library();
    return build(tiles, columns, Vec2(cell, cell));
}

void TileMap::set(std::uint32_t index, Tile tile) {
    detail::enter_library();
    ABUT_ASSERT(index < size() && tile <= Tile::one_way_high_y);
    if (index >= size() || tile > Tile::one_way_high_y) return;
    if (data_.use_count() > 1) data_ = std::make_shared<Data>(*data_);
    data_->tiles[index] = tile;
    const glm::uvec2 place(index % columns(), index / columns());
    data_->blocks.update(place, place + 1u, [&](std::uint32_t x, std::uint32_t y) { return data_->of_tile(x, y); });
}

std::span<const Tile> TileMap::tiles() const {
    return data_->tiles;
}
std::uint32_t TileMap::columns() const {
    return data_->columns;
}
std::uint32_t TileMap::rows() const {
    return data_->rows;
}
Vec2 TileMap::cell() const {
    detail::enter_library();
    return data_->cell;
}
std::uint32_t TileMap::size() const {
    return static_cast<std::uint32_t>(data_->tiles.size());
}

Aabb2 TileMap::box(std::uint32_t index) const {
    detail::enter_library();
    ABUT_ASSERT(index < size());
    return data_->box_of_tile(index % data_->columns, index / data_->columns);
}

Convex<2> TileMap::part(std::uint32_t index) const {
    detail::enter_library();
    return tile_shape(tile(index), box(index));
}

std::uint32_t TileMap::neighbour(std::uint32_t tile, std::uint32_t side) const {
    ABUT_ASSERT(tile < size() && side < 4);
    const std::uint32_t x = tile % data_->columns, y = tile / data_->columns;
    const bool low = side % 2 == 1, along_x = side < 2;
    const std::uint32_t at = along_x ? x : y, count = along_x ? data_->columns : data_->rows;
    if (low ? at == 0 : at + 1 == count) return no_neighbour;
    const std::uint32_t step = along_x ? 1 : data_->columns, beyond = low ? tile - step : tile + step;
    return data_->tiles[beyond] == Tile::empty ? no_neighbour : beyond;
}

Aabb2 bounds(const TileMap& map) {
    detail::enter_library();
    return map.data_->box_of(map.data_->blocks.all());
}

void each_part(const TileMap& map, const Aabb2& box, PartVisitor<2> visit) {
    detail::enter_library();
    const TileMap::Data& data = *map.data_;
    const Aabb2 query = usable(box);
    if (is_empty(query)) return;
    const OccupiedRange& all = data.blocks.all();
    const CellRange columns(query.min.x, query.max.x, data.cell.x, all.end_column);
    const CellRange rows(query.min.y, query.max.y, data.cell.y, all.end_row);
    for (std::uint32_t y = std::max(rows.begin, all.first_row); y < rows.end; ++y)
        for (std::uint32_t x = std::max(columns.begin, all.first_column); x < columns.end; ++x) {
            const std::uint32_t index = x + y * data.columns;
            const Tile tile = data.tiles[index];
            if (tile == Tile::empty) continue;
            const Aabb2 of_tile = data.box_of_tile(x, y);
            if (overlaps(query, of_tile) && !visit(tile_shape(tile, of_tile), index)) return;
        }
}

void each_part_along(const TileMap& map, const MovingBox<2>& box, PartReachVisitor<2> visit) {
    detail::enter_library();
    map.data_->each_within(RayReach<2>::of_box(box), visit);
}

void each_part_near(const TileMap& map, const Aabb2& box, PartReachVisitor<2> visit) {
    detail::enter_library();
    constexpr float any = std::numeric_limits<float>::infinity();
    map.data_->each_within(BoxReach<2>(box, any), visit);
}

}  // namespace abut
