#pragma once

// A Tiled map as plain structs, reduced to what collision detection needs, independent of XML or JSON.
// https://doc.mapeditor.org/en/stable/reference/tmx-map-format/

#include <abut/io/level.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace abut::tiled {

enum class Form : std::uint8_t { rectangle, ellipse, capsule, point, polygon, polyline, text };

struct Object {
    std::uint32_t id = 0;
    std::string name, type;
    detail::DVec<2> position{0}, size{0};
    double rotation = 0;    ///< degrees, clockwise on the screen
    std::uint32_t gid = 0;  ///< nonzero: shows a tile, with flip flags
    Form form = Form::rectangle;
    std::vector<detail::DVec<2>> points;  ///< vertices of polygons and polylines, relative to the position
    std::vector<LevelProperty> properties;
};

/// A rectangle of cells. Each gid is 0 for an empty cell, or a tile's number with flip flags.
struct Cells {
    std::int32_t column = 0, row = 0;  ///< of the first cell
    std::uint32_t columns = 0, rows = 0;
    std::vector<std::uint32_t> gids;
};

enum class LayerKind : std::uint8_t { tiles, objects, image, group };

struct Layer {
    LayerKind kind = LayerKind::group;
    std::uint32_t id = 0;
    std::string name, type;
    detail::DVec<2> offset{0}, parallax{1};
    bool visible = true;
    std::vector<LevelProperty> properties;
    std::vector<Cells> cells;     ///< of a tile layer: one, or the chunks of an infinite map
    std::vector<Object> objects;  ///< of an object layer
    std::vector<Layer> layers;    ///< of a group layer
};

/// The collision data of a tile.
struct TileData {
    detail::DVec<2> size{0};  ///< 0: the tileset's tile size
    std::string type;
    std::vector<LevelProperty> properties;
    std::vector<Object> shapes;
};

struct Tileset {
    std::uint32_t first_gid = 1;
    std::string file;  ///< file it was read from; empty if embedded in the map
    std::string name;
    detail::DVec<2> tile_size{0}, offset{0};
    std::string alignment = "unspecified";
    bool fills_grid = false, keeps_aspect = false;
    std::map<std::uint32_t, TileData> tiles;  ///< tiles with data, by their number in the tileset
};

/// Of a staggered or hexagonal map: every second column or row is shifted by half a cell.
struct Stagger {
    int axis = 1;              ///< 0: columns are shifted, 1: rows
    bool shifts_even = false;  ///< those of even numbers are shifted, and not the odd ones
    double side = 0;           ///< the length of a hexagon's sides along the axis
};

struct Map {
    std::uint32_t columns = 0, rows = 0;
    detail::DVec<2> cell{0};
    bool is_isometric = false;  ///< positions are on the ground, and not on the screen
    std::optional<Stagger> stagger = std::nullopt;
    std::vector<Tileset> tilesets;  ///< sorted by first gid
    std::vector<Layer> layers;
};

/// A template for objects, and the tileset that its gid refers to.
struct Template {
    Object object;
    std::string tileset_file;  ///< empty: none
    std::uint32_t first_gid = 0;
};

// Flag bits of a gid. The diagonal flip (transpose) applies first. The fourth flag rotates tiles of hexagonal maps.
inline constexpr std::uint32_t flip_x = 1u << 31, flip_y = 1u << 30, flip_diagonal = 1u << 29,
                               hexagonal_turn = 1u << 28;
inline constexpr std::uint32_t all_flips = flip_x | flip_y | flip_diagonal | hexagonal_turn;

/// Limits far above any real map; they bound the memory that a small file can allocate.
inline constexpr std::uint64_t max_tiles = std::uint64_t{1} << 26;  ///< per map, over all layers
inline constexpr std::size_t max_objects = std::size_t{1} << 20;
inline constexpr int max_group_depth = 64;
inline constexpr int max_property_depth = 16;

}  // namespace abut::tiled
