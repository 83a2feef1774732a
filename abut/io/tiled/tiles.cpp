#include <abut/io/tiled/grid.hpp>
#include <abut/io/tiled/tiles.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace abut::tiled {

using namespace detail;

namespace {

// Tolerance of a corner's position relative to the cell's size; equals the relative tolerance of queries.
constexpr double corner_tolerance = 1e-5;
// Relative tolerance of the polyline for a capsule that a map distorts to another form.
constexpr double relative_tolerance = 1e-3;

// A corner in units of half a cell, each 0 to 2; nothing for any other position.
std::optional<std::array<int, 2>> in_halves(const Vec2& point, const DVec<2>& cell) {
    std::array<int, 2> result{};
    for (int i = 0; i < 2; ++i) {
        const double halves = 2 * static_cast<double>(point[i]) / cell[i], whole = std::round(halves);
        if (!(std::abs(halves - whole) <= 2 * corner_tolerance) || whole < 0 || whole > 2) return std::nullopt;
        result[static_cast<std::size_t>(i)] = static_cast<int>(whole);
    }
    return result;
}

std::vector<Vec2> corners_of(const PlacedShape& shape) {
    if (const auto* polygon = std::get_if<Polygon>(&shape.shape))
        return {polygon->points().begin(), polygon->points().end()};
    if (const auto* chain = std::get_if<Chain>(&shape.shape); chain != nullptr && !chain->closed())
        return {chain->points().begin(), chain->points().end()};
    const auto* box = std::get_if<Box2>(&shape.shape);
    if (box == nullptr || !(box->rotation == no_rotation<2>)) return {};
    const Vec2 low = box->center - box->half, high = box->center + box->half;
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}

struct Kind {
    Tile tile;
    std::vector<std::array<int, 2>> corners;  ///< in units of half a cell
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all{
        {Tile::full, {{0, 0}, {2, 0}, {2, 2}, {0, 2}}},
        {Tile::half_low_x, {{0, 0}, {1, 0}, {1, 2}, {0, 2}}},
        {Tile::half_high_x, {{1, 0}, {2, 0}, {2, 2}, {1, 2}}},
        {Tile::half_low_y, {{0, 0}, {2, 0}, {2, 1}, {0, 1}}},
        {Tile::half_high_y, {{0, 1}, {2, 1}, {2, 2}, {0, 2}}},
        {Tile::slope_low_x_low_y, {{0, 0}, {2, 0}, {0, 2}}},
        {Tile::slope_high_x_low_y, {{0, 0}, {2, 0}, {2, 2}}},
        {Tile::slope_low_x_high_y, {{0, 0}, {2, 2}, {0, 2}}},
        {Tile::slope_high_x_high_y, {{2, 0}, {2, 2}, {0, 2}}},
        {Tile::one_way_low_x, {{0, 0}, {0, 2}}},
        {Tile::one_way_high_x, {{2, 0}, {2, 2}}},
        {Tile::one_way_low_y, {{0, 0}, {2, 0}}},
        {Tile::one_way_high_y, {{0, 2}, {2, 2}}},
    };
    return all;
}

// The affine map of the flip flags for a tile of this size; updates the size. In a hexagonal map two of them are turns
// by 60 and 120 degrees, after the flips.
Affine<2> flipped(std::uint32_t gid, bool is_hexagonal, DVec<2>& size) {
    if (is_hexagonal) {
        const double angle = ((gid & flip_diagonal) != 0 ? 60 : 0) + ((gid & hexagonal_turn) != 0 ? 120 : 0);
        const DVec<2> flip((gid & flip_x) != 0 ? -1 : 1, (gid & flip_y) != 0 ? -1 : 1);
        return translation_by(0.5 * size) * rotation_by(angle) * scaling_by(flip) * translation_by(-0.5 * size);
    }
    Affine<2> result;
    if ((gid & flip_diagonal) != 0) {
        result.column = {DVec<2>(0, 1), DVec<2>(1, 0)};
        std::swap(size.x, size.y);
    }
    if ((gid & flip_x) != 0) result = translation_by({size.x, 0}) * scaling_by({-1, 1}) * result;
    if ((gid & flip_y) != 0) result = translation_by({0, size.y}) * scaling_by({1, -1}) * result;
    return result;
}

Result<std::vector<PlacedShape>> place_all(const Affine<2>& map, const std::vector<Object>& objects) {
    std::vector<PlacedShape> result;
    for (const Object& object : objects) {
        if (object.form == Form::point || object.form == Form::text) continue;
        Result<PlacedShape> shape = place_object(map, object);
        if (shape)
            result.push_back(*std::move(shape));
        else if (shape.problem().code != ProblemCode::degenerate)
            return shape.problem();
    }
    return result;
}

}  // namespace

Result<PlacedShape> place_object(const Affine<2>& map, const Object& object) {
    const Affine<2> place = map * translation_by(object.position) * rotation_by(object.rotation);
    const DVec<2>& size = object.size;
    switch (object.form) {
        case Form::ellipse:
            return place_ellipse(place * translation_by(0.5 * size), 0.5 * size);
        case Form::capsule: {
            const DVec<2> radii(0.5 * std::min(size.x, size.y));
            return place_rounded_rectangle(place, size, radii, relative_tolerance * radii.x);
        }
        case Form::polygon:
            return place_polyline(place, object.points, true, true);
        case Form::polyline:
            return place_polyline(place, object.points, false, false);
        case Form::rectangle:
        case Form::point:
        case Form::text:
            return place_rectangle(place, size);
    }
    return Problem{ProblemCode::bad_argument, "an object of no form"};
}

Tile kind_of(std::span<const PlacedShape> shapes, const DVec<2>& cell) {
    if (shapes.size() != 1) return Tile::empty;
    std::vector<std::array<int, 2>> corners;
    for (const Vec2& corner : corners_of(shapes[0])) {
        const auto place = in_halves(corner, cell);
        if (!place) return Tile::empty;
        corners.push_back(*place);
    }
    const auto has = [](const auto& all, const auto& one) {
        return std::find(all.begin(), all.end(), one) != all.end();
    };
    for (const Kind& kind : kinds())
        if (kind.corners.size() == corners.size() &&
            std::all_of(kind.corners.begin(), kind.corners.end(),
                        [&](const auto& corner) { return has(corners, corner); }))
            return kind.tile;
    return Tile::empty;
}

Tiles::Tiles(const Map& map) : map_(map) {
    for (const Tileset& tileset : map.tilesets)
        for (const auto& [number, tile] : tileset.tiles) have_shapes_ = have_shapes_ || !tile.shapes.empty();
}

const Tileset* Tiles::tileset_of(std::uint32_t gid) const {
    const Tileset* result = nullptr;
    for (const Tileset& tileset : map_.tilesets)
        if (tileset.first_gid <= (gid & ~all_flips) && (result == nullptr || tileset.first_gid >= result->first_gid))
            result = &tileset;
    return result;
}

const TileData* Tiles::tile_of(std::uint32_t gid) const {
    const Tileset* tileset = tileset_of(gid);
    if (tileset == nullptr) return nullptr;
    const auto found = tileset->tiles.find((gid & ~all_flips) - tileset->first_gid);
    return found == tileset->tiles.end() ? nullptr : &found->second;
}

DVec<2> Tiles::size_of(std::uint32_t gid) const {
    const Tileset* tileset = tileset_of(gid);
    const TileData* tile = tile_of(gid);
    if (tile != nullptr && tile->size.x > 0 && tile->size.y > 0) return tile->size;
    if (tileset != nullptr && tileset->tile_size.x > 0 && tileset->tile_size.y > 0) return tileset->tile_size;
    return map_.cell;
}

Result<TileCollision> Tiles::compute_collision(std::uint32_t gid) const {
    const TileData* tile = tile_of(gid);
    if (!have_shapes_ && map_.stagger) {
        Result<PlacedShape> outline = place_polyline({}, cell_outline(map_), true, true);
        if (!outline) return outline.problem();
        return TileCollision{Tile::empty, {*std::move(outline)}};
    }
    if (!have_shapes_) return TileCollision{Tile::full, {}};
    if (tile == nullptr || tile->shapes.empty()) return TileCollision{};
    // Shapes are drawn on the picture of the tile, which shows the ground from an angle.
    if (map_.is_isometric) return TileCollision{Tile::full, {}};
    const Tileset& tileset = *tileset_of(gid);
    DVec<2> size = size_of(gid);
    Affine<2> map = flipped(gid, is_hexagonal(), size);
    if (tileset.fills_grid) {
        DVec<2> scale = map_.cell / size;
        if (tileset.keeps_aspect) scale = DVec<2>(std::min(scale.x, scale.y));
        map = translation_by(0.5 * (map_.cell - scale * size)) * scaling_by(scale) * map;
    } else {
        // Larger tiles are aligned to the cell's bottom left corner and extend up and to the right.
        map = translation_by({0, map_.cell.y - size.y}) * map;
    }
    Result<std::vector<PlacedShape>> shapes = place_all(translation_by(tileset.offset) * map, tile->shapes);
    if (!shapes) return shapes.problem();
    const Tile kind = map_.stagger ? Tile::empty : kind_of(*shapes, map_.cell);
    if (kind != Tile::empty) return TileCollision{kind, {}};
    return TileCollision{Tile::empty, *std::move(shapes)};
}

Result<const TileCollision*> Tiles::collision(std::uint32_t gid) {
    const auto known = collisions_.find(gid);
    if (known != collisions_.end()) return &known->second;
    Result<TileCollision> collision = compute_collision(gid);
    if (!collision)
        return Problem{collision.problem().code,
                       "tile " + std::to_string(gid & ~all_flips) + ": " + collision.problem().message};
    return &collisions_.emplace(gid, *std::move(collision)).first->second;
}

Result<std::vector<PlacedShape>> Tiles::shown(std::uint32_t gid, const DVec<2>& size, const Affine<2>& map) const {
    const TileData* tile = tile_of(gid);
    DVec<2> own_size = size_of(gid);
    const Affine<2> flip = flipped(gid, is_hexagonal(), own_size);
    DVec<2> scale = size / own_size;
    const Tileset* tileset = tileset_of(gid);
    if (tileset != nullptr && tileset->keeps_aspect) scale = DVec<2>(std::min(scale.x, scale.y));
    const Affine<2> whole = map * translation_by(0.5 * (size - scale * own_size)) * scaling_by(scale) * flip;
    Result<std::vector<PlacedShape>> shapes = std::vector<PlacedShape>();
    if (tile != nullptr) shapes = place_all(whole, tile->shapes);
    if (!shapes || !shapes->empty()) return shapes;
    Result<PlacedShape> rectangle = place_rectangle(map, size);
    if (!rectangle) return rectangle.problem();
    return std::vector<PlacedShape>{*std::move(rectangle)};
}

}  // namespace abut::tiled
