#include <abut/io/tiled/fields.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace abut::tiled {

double Fields::number(const char* key, double default_value, Defects& defects) const {
    if (!has(key)) return default_value;
    const std::optional<double> value = as_number(key);
    if (value && std::isfinite(*value)) return *value;
    defects.fail(ProblemCode::bad_format, where() + key + ": a number was expected");
    return default_value;
}

bool Fields::flag(const char* key, bool default_value, Defects& defects) const {
    if (!has(key)) return default_value;
    const std::optional<bool> value = as_flag(key);
    if (!value) defects.fail(ProblemCode::bad_format, where() + key + ": true or false was expected");
    return value.value_or(default_value);
}

std::int64_t Fields::whole(const char* key, std::int64_t default_value, std::int64_t min, std::int64_t max,
                           Defects& defects) const {
    if (!has(key)) return default_value;
    const std::optional<double> value = as_number(key);
    if (value && *value >= static_cast<double>(min) && *value <= static_cast<double>(max) &&
        *value == std::floor(*value))
        return static_cast<std::int64_t>(*value);
    defects.fail(ProblemCode::bad_format, where() + key + ": a whole number from " + std::to_string(min) + " to " +
                                              std::to_string(max) + " was expected");
    return default_value;
}

std::uint32_t Fields::count(const char* key, std::uint32_t default_value, Defects& defects) const {
    return static_cast<std::uint32_t>(whole(key, default_value, 0, std::numeric_limits<std::uint32_t>::max(), defects));
}

// Tiled 1.9 alone names the type of objects and tiles "class".
void read_type(const Fields& fields, std::string& type) {
    for (const char* key : {"type", "class"})
        if (fields.has(key)) type = fields.text(key);
}

void read_map(const Fields& fields, Map& map, Defects& defects) {
    const std::string orientation = fields.has("orientation") ? fields.text("orientation") : "orthogonal";
    map.is_isometric = orientation == "isometric";
    if (orientation == "staggered" || orientation == "hexagonal") {
        map.stagger = {fields.text("staggeraxis") == "x" ? 0 : 1, fields.text("staggerindex") == "even", 0};
        if (orientation == "hexagonal") map.stagger->side = fields.number("hexsidelength", 0, defects);
    } else if (orientation != "orthogonal" && !map.is_isometric) {
        defects.fail(ProblemCode::bad_argument,
                     fields.where() + "the map is '" + orientation + "', which is no orientation that abut knows");
    }
    map.columns = fields.count("width", 0, defects);
    map.rows = fields.count("height", 0, defects);
    map.cell = {fields.number("tilewidth", 0, defects), fields.number("tileheight", 0, defects)};
    if (!(map.cell.x > 0 && map.cell.y > 0))
        defects.fail(ProblemCode::bad_format, fields.where() + "tilewidth and tileheight must be above 0");
    if (map.stagger && !(map.stagger->side >= 0 && map.stagger->side < map.cell[map.stagger->axis]))
        defects.fail(ProblemCode::bad_format, fields.where() + "hexsidelength must be less than the tile's size");
    if (map.stagger && !(map.cell.x >= 2 && map.cell.y >= 2))
        defects.fail(ProblemCode::bad_format, fields.where() + "tilewidth and tileheight must be at least 2");
    // On the ground, where Tiled measures the objects of such a map, a cell is a square.
    if (map.is_isometric) map.cell.x = map.cell.y;
}

void read_layer(const Fields& fields, Layer& layer, Defects& defects) {
    layer.id = fields.count("id", 0, defects);
    layer.name = fields.text("name");
    if (fields.has("class")) layer.type = fields.text("class");
    layer.offset = {fields.number("offsetx", 0, defects), fields.number("offsety", 0, defects)};
    layer.parallax = {fields.number("parallaxx", 1, defects), fields.number("parallaxy", 1, defects)};
    layer.visible = fields.flag("visible", true, defects);
}

void read_tileset(const Fields& fields, Tileset& tileset, Defects& defects) {
    tileset.name = fields.text("name");
    tileset.tile_size = {fields.number("tilewidth", 0, defects), fields.number("tileheight", 0, defects)};
    if (fields.has("objectalignment")) tileset.alignment = fields.text("objectalignment");
    tileset.fills_grid = fields.text("tilerendersize") == "grid";
    tileset.keeps_aspect = fields.text("fillmode") == "preserve-aspect-fit";
}

void read_object(const Fields& fields, Object& object, Defects& defects) {
    object.id = fields.count("id", object.id, defects);
    if (fields.has("name")) object.name = fields.text("name");
    read_type(fields, object.type);
    object.position = {fields.number("x", object.position.x, defects), fields.number("y", object.position.y, defects)};
    object.size = {fields.number("width", object.size.x, defects), fields.number("height", object.size.y, defects)};
    object.rotation = fields.number("rotation", object.rotation, defects);
    object.gid = fields.count("gid", object.gid, defects);
}

void set_property(std::vector<LevelProperty>& properties, LevelProperty property) {
    const auto known = std::find_if(properties.begin(), properties.end(),
                                    [&](const LevelProperty& one) { return one.name == property.name; });
    if (known == properties.end())
        properties.push_back(std::move(property));
    else
        *known = std::move(property);
}

std::string shortest(double number) {
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
    return std::string(text.data(), error == std::errc() ? end : text.data());
}

bool Budget::take_tiles(const Cells& cells, const std::string& where, Defects& defects) {
    const std::uint64_t tiles = std::uint64_t{cells.columns} * cells.rows;
    if (tiles <= max_tiles && tiles_ + tiles <= max_tiles) {
        tiles_ += tiles;
        return true;
    }
    defects.fail(ProblemCode::too_large, where + std::to_string(cells.columns) + " x " + std::to_string(cells.rows) +
                                             " tiles; a map may have " + std::to_string(max_tiles) + " in all");
    return false;
}

bool Budget::take_object(const std::string& where, Defects& defects) {
    if (++objects_ <= max_objects) return true;
    defects.fail(ProblemCode::too_large, where + "more than " + std::to_string(max_objects) + " objects");
    return false;
}

void add_tileset(const std::string& name, std::uint32_t first_gid, Map& map, Files& files, const std::string& where,
                 Defects& defects) {
    Result<Tileset> tileset = files.tileset(name);
    if (!tileset) return defects.fail(tileset.problem().code, where + tileset.problem().message);
    tileset->first_gid = first_gid;
    map.tilesets.push_back(*std::move(tileset));
}

Object instantiate_template(const std::string& name, Map& map, Files& files, const std::string& where,
                            Defects& defects) {
    const Result<const Template*> found = files.object_template(name);
    if (!found) {
        defects.fail(found.problem().code, where + found.problem().message);
        return {};
    }
    const Template& from = **found;
    Object object = from.object;
    if (object.gid == 0 || from.tileset_file.empty()) return object;
    const auto same_file = [&](const Tileset& tileset) { return tileset.file == from.tileset_file; };
    auto tileset = std::find_if(map.tilesets.begin(), map.tilesets.end(), same_file);
    if (tileset == map.tilesets.end()) {
        // A tileset used by templates only is missing in the map's list: its gids begin far above those of all others.
        constexpr std::uint32_t first_template_gid = 1u << 24, max_tiles_per_tileset = 1u << 20;
        std::uint32_t first = first_template_gid;
        for (const Tileset& other : map.tilesets) first = std::max(first, other.first_gid + max_tiles_per_tileset);
        if (first >= hexagonal_turn) {
            defects.fail(ProblemCode::too_large, where + "too many tilesets");
            return object;
        }
        add_tileset(from.tileset_file, first, map, files, where, defects);
        if (defects.first) return object;
        tileset = map.tilesets.end() - 1;
    }
    const std::uint32_t number = (object.gid & ~all_flips) - from.first_gid;
    object.gid = (object.gid & all_flips) | (tileset->first_gid + number);
    return object;
}

}  // namespace abut::tiled
