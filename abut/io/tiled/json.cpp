#include <abut/io/file/parse_json-inl.h>
#include <abut/io/tiled/cells.hpp>
#include <abut/io/tiled/fields.hpp>

#include <limits>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace abut::tiled {
namespace {

using Json = nlohmann::json;

const Json& member(const Json& object, const char* key) {
    static const Json nothing;
    if (!object.is_object()) return nothing;
    const auto found = object.find(key);
    return found == object.end() ? nothing : *found;
}

std::string text_of(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
    if (value.is_number()) return shortest(value.get<double>());
    return {};
}

class JsonFields final : public Fields {
public:
    JsonFields(const Json& object, std::string place) : object_(object), place_(std::move(place)) {}

    bool has(const char* key) const override { return !member(object_, key).is_null(); }
    std::string text(const char* key) const override { return text_of(member(object_, key)); }
    std::optional<double> as_number(const char* key) const override {
        const Json& value = member(object_, key);
        return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
    }
    std::optional<bool> as_flag(const char* key) const override {
        const Json& value = member(object_, key);
        return value.is_boolean() ? std::optional(value.get<bool>()) : std::nullopt;
    }
    std::string where() const override { return place_.empty() ? std::string() : place_ + ": "; }

private:
    const Json& object_;
    std::string place_;
};

class JsonReader {
public:
    JsonReader(Map* map, Files* files) : map_(map), files_(files) {}

    void map(const Json& json);
    void tileset(const Json& json, const std::string& place, Tileset& to);
    void object_template(const Json& json, Template& to);

    Defects defects;

private:
    void fail(const std::string& place, const std::string& what) {
        defects.fail(ProblemCode::bad_format, place + ": " + what);
    }
    /// Visits the elements of an array, each an object, with their locations; stops at the first error.
    template <class Visit>
    void each(const Json& json, const char* key, const std::string& place, Visit visit);

    void properties(const Json& json, const std::string& place, std::vector<LevelProperty>& to);
    void property(const Json& value, const std::string& name, std::string type, const std::string& place,
                  std::vector<LevelProperty>& to, int depth);
    void layers(const Json& json, const std::string& place, std::vector<Layer>& to, int depth);
    void tiles(const Json& data, const Json& layer_json, const std::string& place, Cells& cells);
    void tile_layer(const Json& json, const std::string& place, Layer& layer);
    void objects(const Json& json, const std::string& place, std::vector<Object>& to);
    void object(const Json& json, const std::string& place, Object& to);
    void points(const Json& json, const char* key, const std::string& place, Object& to);

    Map* map_;      ///< the map being read; null for tilesets and templates
    Files* files_;  ///< null for tilesets and templates
    bool infinite_ = false;
    Budget budget_;
};

template <class Visit>
void JsonReader::each(const Json& json, const char* key, const std::string& place, Visit visit) {
    const Json& array = member(json, key);
    if (array.is_null()) return;
    const std::string whole = place.empty() ? std::string(key) : place + "." + key;
    if (!array.is_array()) return fail(whole, "an array was expected");
    std::size_t i = 0;
    for (const Json& element : array) {
        const std::string at = whole + "[" + std::to_string(i++) + "]";
        if (!element.is_object()) return fail(at, "an object was expected");
        visit(element, at);
        if (defects.first) return;
    }
}

void JsonReader::property(const Json& value, const std::string& name, std::string type, const std::string& place,
                          std::vector<LevelProperty>& to, int depth) {
    if (depth > max_property_depth) return fail(place, "properties are nested more than 16 deep");
    if (!value.is_object()) return set_property(to, {name, std::move(type), text_of(value)});
    for (const auto& [key, inner] : value.items()) {
        const char* of_inner = inner.is_boolean() ? "bool" : inner.is_number_float() ? "float" : "int";
        property(inner, name + "." + key, inner.is_string() ? "string" : of_inner, place, to, depth + 1);
    }
}

void JsonReader::properties(const Json& json, const std::string& place, std::vector<LevelProperty>& to) {
    // Before Tiled 1.2, properties are a single object.
    if (const Json& old = member(json, "properties"); old.is_object()) {
        for (const auto& [name, value] : old.items())
            property(value, name, JsonFields(member(json, "propertytypes"), place).text(name.c_str()), place, to, 0);
        return;
    }
    each(json, "properties", place, [&](const Json& one, const std::string& at) {
        const JsonFields fields(one, at);
        property(member(one, "value"), fields.text("name"), fields.has("type") ? fields.text("type") : "string", at, to,
                 0);
    });
}

void JsonReader::points(const Json& json, const char* key, const std::string& place, Object& to) {
    to.points.clear();
    each(json, key, place, [&](const Json& point, const std::string& at) {
        const JsonFields fields(point, at);
        const double x = fields.number("x", 0, defects);
        to.points.emplace_back(x, fields.number("y", 0, defects));
    });
}

void JsonReader::object(const Json& json, const std::string& place, Object& to) {
    const JsonFields fields(json, place);
    read_object(fields, to, defects);
    properties(json, place, to.properties);
    if (fields.flag("ellipse", false, defects)) to.form = Form::ellipse;
    if (fields.flag("capsule", false, defects)) to.form = Form::capsule;
    if (fields.flag("point", false, defects)) to.form = Form::point;
    if (fields.has("text")) to.form = Form::text;
    for (const auto& [key, form] : {std::pair("polygon", Form::polygon), std::pair("polyline", Form::polyline)}) {
        if (!fields.has(key)) continue;
        to.form = form;
        points(json, key, place, to);
    }
}

void JsonReader::objects(const Json& json, const std::string& place, std::vector<Object>& to) {
    each(json, "objects", place, [&](const Json& one, const std::string& at) {
        if (!budget_.take_object(at + ": ", defects)) return;
        Object made;
        const JsonFields fields(one, at);
        if (fields.has("template") && map_ != nullptr)
            made = instantiate_template(resolved_path("", fields.text("template")), *map_, *files_, at + ": ", defects);
        object(one, at, made);
        to.push_back(std::move(made));
    });
}

// `layer_json` names the encoding of the data.
void JsonReader::tiles(const Json& data, const Json& layer_json, const std::string& place, Cells& cells) {
    if (!budget_.take_tiles(cells, place + ": ", defects)) return;
    const std::size_t count = std::size_t{cells.columns} * cells.rows;
    if (data.is_string()) {
        Result<std::vector<std::uint32_t>> gids = cells_from_base64(
            data.get_ref<const std::string&>(), JsonFields(layer_json, place).text("compression"), count);
        if (!gids) return defects.fail(gids.problem().code, place + ": " + gids.problem().message);
        cells.gids = *std::move(gids);
        return;
    }
    if (!data.is_array()) return fail(place + ".data", "an array or a text was expected");
    if (data.size() != count)
        return fail(place, std::to_string(data.size()) + " tiles, where " + std::to_string(count) + " were expected");
    cells.gids.reserve(count);
    for (const Json& gid : data) {
        const bool fits =
            gid.is_number_unsigned() && gid.get<std::uint64_t>() <= std::numeric_limits<std::uint32_t>::max();
        if (!fits)
            return fail(place + ".data[" + std::to_string(cells.gids.size()) + "]",
                        "a whole number of 32 bits was expected");
        cells.gids.push_back(gid.get<std::uint32_t>());
    }
}

void JsonReader::tile_layer(const Json& json, const std::string& place, Layer& layer) {
    constexpr std::int64_t farthest = 1 << 30;
    each(json, "chunks", place, [&](const Json& chunk, const std::string& at) {
        Cells cells;
        const JsonFields fields(chunk, at);
        cells.column = static_cast<std::int32_t>(fields.whole("x", 0, -farthest, farthest, defects));
        cells.row = static_cast<std::int32_t>(fields.whole("y", 0, -farthest, farthest, defects));
        cells.columns = fields.count("width", 0, defects);
        cells.rows = fields.count("height", 0, defects);
        if (!defects.first) tiles(member(chunk, "data"), json, at, cells);
        layer.cells.push_back(std::move(cells));
    });
    if (infinite_ || member(json, "chunks").is_array()) return;
    Cells cells;
    const JsonFields fields(json, place);
    cells.columns = fields.count("width", map_->columns, defects);
    cells.rows = fields.count("height", map_->rows, defects);
    if (!defects.first) tiles(member(json, "data"), json, place + " (layer '" + layer.name + "')", cells);
    layer.cells.push_back(std::move(cells));
}

void JsonReader::layers(const Json& json, const std::string& place, std::vector<Layer>& to, int depth) {
    if (depth > max_group_depth)
        return defects.fail(ProblemCode::too_large, place + ": groups are nested more than 64 deep");
    each(json, "layers", place, [&](const Json& one, const std::string& at) {
        const JsonFields fields(one, at);
        const std::string type = fields.text("type");
        Layer layer;
        read_layer(fields, layer, defects);
        properties(one, at, layer.properties);
        if (type == "tilelayer") {
            layer.kind = LayerKind::tiles;
            tile_layer(one, at, layer);
        } else if (type == "objectgroup") {
            layer.kind = LayerKind::objects;
            objects(one, at, layer.objects);
        } else if (type == "imagelayer") {
            layer.kind = LayerKind::image;
        } else if (type == "group") {
            layers(one, at, layer.layers, depth + 1);
        } else {
            fail(at, "unknown type of layer '" + type + "'");
        }
        to.push_back(std::move(layer));
    });
}

void JsonReader::tileset(const Json& json, const std::string& place, Tileset& to) {
    read_tileset(JsonFields(json, place), to, defects);
    const JsonFields offset(member(json, "tileoffset"), place);
    to.offset = {offset.number("x", 0, defects), offset.number("y", 0, defects)};
    each(json, "tiles", place, [&](const Json& one, const std::string& at) {
        const JsonFields fields(one, at);
        TileData& tile = to.tiles[fields.count("id", 0, defects)];
        read_type(fields, tile.type);
        properties(one, at, tile.properties);
        tile.size = {fields.number("imagewidth", 0, defects), fields.number("imageheight", 0, defects)};
        tile.size = {fields.number("width", tile.size.x, defects), fields.number("height", tile.size.y, defects)};
        objects(member(one, "objectgroup"), at + ".objectgroup", tile.shapes);
    });
}

void JsonReader::map(const Json& json) {
    read_map(JsonFields(json, ""), *map_, defects);
    infinite_ = JsonFields(json, "").flag("infinite", false, defects);
    each(json, "tilesets", "", [&](const Json& one, const std::string& at) {
        const JsonFields fields(one, at);
        const std::uint32_t first = fields.count("firstgid", 1, defects);
        if (fields.has("source"))
            return add_tileset(resolved_path("", fields.text("source")), first, *map_, *files_, at + ": ", defects);
        Tileset made;
        made.first_gid = first;
        tileset(one, at, made);
        map_->tilesets.push_back(std::move(made));
    });
    if (!defects.first) layers(json, "", map_->layers, 0);
}

void JsonReader::object_template(const Json& json, Template& to) {
    const JsonFields set(member(json, "tileset"), "tileset");
    to.first_gid = set.count("firstgid", 1, defects);
    to.tileset_file = set.text("source");
    if (!member(json, "object").is_object()) return fail("object", "an object was expected");
    object(member(json, "object"), "object", to.object);
}

template <class T, class Read>
Result<T> read(std::span<const std::byte> bytes, Files* files, Read read_it) {
    const Result<Json> parsed = detail::parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!parsed) return parsed.problem();
    const Json& json = *parsed;
    if (!json.is_object()) return Problem{ProblemCode::bad_format, "JSON: an object was expected"};
    T result;
    Map* map = nullptr;
    if constexpr (std::is_same_v<T, Map>) map = &result;
    JsonReader reader(map, files);
    read_it(reader, json, result);
    if (reader.defects.first) return *reader.defects.first;
    return result;
}

}  // namespace

Result<Map> map_from_json(std::span<const std::byte> bytes, Files& files) {
    return read<Map>(bytes, &files, [](JsonReader& reader, const Json& json, Map&) {
        if (!member(json, "layers").is_array() || !member(json, "tilewidth").is_number())
            return reader.defects.fail(ProblemCode::bad_format, "not a Tiled map: it has no layers and tilewidth");
        reader.map(json);
    });
}

Result<Tileset> tileset_from_json(std::span<const std::byte> bytes) {
    return read<Tileset>(bytes, nullptr, [](JsonReader& reader, const Json& json, Tileset& tileset) {
        reader.tileset(json, "", tileset);
    });
}

Result<Template> template_from_json(std::span<const std::byte> bytes) {
    return read<Template>(bytes, nullptr, [](JsonReader& reader, const Json& json, Template& made) {
        reader.object_template(json, made);
    });
}

}  // namespace abut::tiled
