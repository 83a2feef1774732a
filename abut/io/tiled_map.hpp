#pragma once

// A Tiled map as plain structs, of which only what collision needs is kept, whether it was written as XML or as JSON.
// https://doc.mapeditor.org/en/stable/reference/tmx-map-format/

#include <abut/io/level.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace abut::tiled {

enum class Form : std::uint8_t { rectangle, ellipse, capsule, point, polygon, polyline, text };

struct Object {
    std::uint32_t id = 0;
    std::string name, type;
    DVec<2> position{0}, size{0};
    double rotation = 0;    ///< degrees, clockwise on the screen
    std::uint32_t gid = 0;  ///< other than 0: a tile is shown, with its flips
    Form form = Form::rectangle;
    std::vector<DVec<2>> points;  ///< of polygons and polylines, from the position
    std::vector<LevelProperty> properties;
};

/// A rectangle of tiles. Each is 0 for nothing, or a number with its flips.
struct Cells {
    std::int32_t column = 0, row = 0;  ///< of the first
    std::uint32_t columns = 0, rows = 0;
    std::vector<std::uint32_t> gids;
};

enum class LayerKind : std::uint8_t { tiles, objects, image, group };

struct Layer {
    LayerKind kind = LayerKind::group;
    std::uint32_t id = 0;
    std::string name, type;
    DVec<2> offset{0}, parallax{1};
    bool visible = true;
    std::vector<LevelProperty> properties;
    std::vector<Cells> cells;     ///< of tiles: one, or the chunks of an infinite map
    std::vector<Object> objects;  ///< of objects
    std::vector<Layer> layers;    ///< of a group
};

/// Of a tile only what it collides with.
struct TileData {
    DVec<2> size{0};  ///< 0: as its tileset says
    std::string type;
    std::vector<LevelProperty> properties;
    std::vector<Object> shapes;
};

struct Tileset {
    std::uint32_t first_gid = 1;
    std::string file;  ///< it comes from; empty where it is part of the map
    std::string name;
    DVec<2> tile_size{0}, offset{0};
    std::string alignment = "unspecified";
    bool fills_grid = false, keeps_aspect = false;
    std::map<std::uint32_t, TileData> tiles;  ///< those that have anything to tell, by their number in the tileset
};

struct Map {
    std::uint32_t columns = 0, rows = 0;
    DVec<2> cell{0};
    std::vector<Tileset> tilesets;  ///< in the order of their first gids
    std::vector<Layer> layers;
};

/// An object that others are made of, and the tileset that its gid is about.
struct Template {
    Object object;
    std::string tileset_file;  ///< empty: none
    std::uint32_t first_gid = 0;
};

// The highest bits of a gid. The diagonal flip, along the diagonal from the top left, is done first; the fourth turns
// tiles of hexagonal maps.
inline constexpr std::uint32_t flip_x = 1u << 31, flip_y = 1u << 30, flip_diagonal = 1u << 29,
                               hexagonal_turn = 1u << 28;
inline constexpr std::uint32_t all_flips = flip_x | flip_y | flip_diagonal | hexagonal_turn;

/// Limits, far above any map that is played, and far below what a few bytes of a file can ask for.
inline constexpr std::uint64_t most_tiles = std::uint64_t{1} << 26;  ///< of a map, all layers together
inline constexpr std::size_t most_objects = std::size_t{1} << 20;
inline constexpr int deepest_group = 64;

}  // namespace abut::tiled
