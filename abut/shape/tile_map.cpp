#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/detail/cell_grid.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/triangle.hpp>

#include <vector>

namespace abut {

using namespace detail;

namespace {

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
    CellGrid<2> grid;

    bool operator()(std::uint32_t index) const { return tiles[index] != Tile::empty; }

    template <class Reach>
    void each_within(const Reach& reach, PartReachVisitor<2> visit) const {
        grid.each_within(reach, *this, [&](const Aabb2& box, std::uint32_t index) {
            return visit(tile_shape(tiles[index], box), index);
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
    data->grid.count = {columns, static_cast<std::uint32_t>(tiles.size() / columns)};
    data->grid.cell = cell;
    if (!(cell.x > 0 && cell.y > 0 && is_finite(data->grid.box_of(glm::uvec2(0u), data->grid.count).max)))
        return Problem{ProblemCode::bad_argument, "the cells' sizes must be above zero, and their places finite", 0};
    data->grid.build(*data);
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
    data_->grid.update(index, *data_);
    changed_.add(box(index));
}

std::span<const Tile> TileMap::tiles() const {
    return data_->tiles;
}
std::uint32_t TileMap::columns() const {
    return data_->grid.count.x;
}
std::uint32_t TileMap::rows() const {
    return data_->grid.count.y;
}
Vec2 TileMap::cell() const {
    detail::enter_library();
    return data_->grid.cell;
}
std::uint32_t TileMap::size() const {
    return static_cast<std::uint32_t>(data_->tiles.size());
}

Aabb2 TileMap::box(std::uint32_t index) const {
    detail::enter_library();
    ABUT_ASSERT(index < size());
    return data_->grid.box_of(data_->grid.place_of(index));
}

Convex<2> TileMap::part(std::uint32_t index) const {
    detail::enter_library();
    return tile_shape(tile(index), box(index));
}

std::uint32_t TileMap::neighbour(std::uint32_t tile, std::uint32_t side) const {
    ABUT_ASSERT(tile < size() && side < 4);
    return data_->grid.neighbour(tile, side, *data_);
}

Aabb2 bounds(const TileMap& map) {
    detail::enter_library();
    return map.data_->grid.bounds();
}

Aabb2 take_changed(TileMap& map) {
    return map.changed_.take();
}

void each_part(const TileMap& map, const Aabb2& box, PartVisitor<2> visit) {
    detail::enter_library();
    const TileMap::Data& data = *map.data_;
    data.grid.each_overlapping(box, data, [&](const Aabb2& of_tile, std::uint32_t index) {
        return visit(tile_shape(data.tiles[index], of_tile), index);
    });
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
