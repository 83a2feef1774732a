#include <abut/io/file/scanner.hpp>
#include <abut/io/file/xml-inl.h>
#include <abut/io/tiled/cells.hpp>
#include <abut/io/tiled/fields.hpp>

#include <string_view>
#include <utility>

namespace abut::tiled {
namespace {

using pugi::xml_node;
using std::string_view_literals::operator""sv;

class XmlFields final : public Fields {
public:
    XmlFields(const detail::Xml& xml, const xml_node& node) : xml_(xml), node_(node) {}

    bool has(const char* key) const override { return static_cast<bool>(node_.attribute(key)); }
    std::string text(const char* key) const override { return node_.attribute(key).value(); }
    std::optional<double> as_number(const char* key) const override {
        detail::Scanner scanner(node_.attribute(key).value());
        const std::optional<double> value = scanner.number();
        return scanner.at_end() ? value : std::nullopt;
    }
    std::optional<bool> as_flag(const char* key) const override {
        const std::string_view value = node_.attribute(key).value();
        if (value == "1" || value == "true") return true;
        return value == "0" || value == "false" ? std::optional(false) : std::nullopt;
    }
    std::string where() const override { return xml_.line(node_); }

private:
    const detail::Xml& xml_;
    xml_node node_;
};

class XmlReader {
public:
    XmlReader(const detail::Xml& xml, Map* map, Files* files) : xml_(xml), map_(map), files_(files) {}

    void map(const xml_node& node);
    void tileset(const xml_node& node, Tileset& to);
    void object_template(const xml_node& node, Template& to);

    Defects defects;

private:
    void fail(const xml_node& node, const std::string& what) {
        defects.fail(ProblemCode::bad_format, xml_.line(node) + what);
    }
    XmlFields fields(const xml_node& node) const { return {xml_, node}; }

    void properties(const xml_node& node, std::vector<LevelProperty>& to, const std::string& prefix = {},
                    int depth = 0);
    void layers(const xml_node& node, std::vector<Layer>& to, int depth);
    void tiles(const xml_node& data, const Layer& layer, const std::string& encoding, const std::string& compression,
               Cells& cells);
    void tile_layer(const xml_node& node, Layer& layer);
    void objects(const xml_node& node, std::vector<Object>& to);
    void object(const xml_node& node, Object& to);
    void points(const xml_node& node, Object& to);

    const detail::Xml& xml_;
    Map* map_;      ///< the map being read; null for tilesets and templates
    Files* files_;  ///< null for tilesets and templates
    Budget budget_;
};

void XmlReader::properties(const xml_node& node, std::vector<LevelProperty>& to, const std::string& prefix, int depth) {
    if (depth > max_property_depth) return fail(node, "properties are nested more than 16 deep");
    for (const xml_node& one : node.child("properties").children("property")) {
        const std::string name = prefix + one.attribute("name").value();
        std::string type = one.attribute("type").value();
        if (type.empty()) type = "string";
        if (one.child("properties")) {
            properties(one, to, name + ".", depth + 1);
            continue;
        }
        // A multi-line string is the content of the element.
        std::string value = one.attribute("value") ? one.attribute("value").value() : one.child_value();
        if (type == "float" || type == "int")
            if (const std::optional<double> number = fields(one).as_number("value")) value = shortest(*number);
        set_property(to, {name, std::move(type), std::move(value)});
    }
}

void XmlReader::points(const xml_node& node, Object& to) {
    to.points.clear();
    detail::Scanner scanner(node.attribute("points").value());
    while (!scanner.at_end()) {
        const std::optional<double> x = scanner.number(), y = x ? scanner.number() : std::nullopt;
        if (!y) return fail(node, "points: pairs of numbers were expected");
        to.points.emplace_back(*x, *y);
    }
}

void XmlReader::object(const xml_node& node, Object& to) {
    read_object(fields(node), to, defects);
    properties(node, to.properties);
    for (const xml_node& child : node.children()) {
        const std::string_view name = child.name();
        if (name == "ellipse"sv) to.form = Form::ellipse;
        if (name == "capsule"sv) to.form = Form::capsule;
        if (name == "point"sv) to.form = Form::point;
        if (name == "text"sv) to.form = Form::text;
        if (name == "polygon"sv) to.form = Form::polygon;
        if (name == "polyline"sv) to.form = Form::polyline;
        if (name == "polygon"sv || name == "polyline"sv) points(child, to);
    }
}

void XmlReader::objects(const xml_node& node, std::vector<Object>& to) {
    for (const xml_node& one : node.children("object")) {
        const std::string where = xml_.line(one);
        if (defects.first || !budget_.take_object(where, defects)) return;
        Object made;
        if (const pugi::xml_attribute from = one.attribute("template"); from && map_ != nullptr)
            made = instantiate_template(resolved_path("", from.value()), *map_, *files_, where, defects);
        object(one, made);
        to.push_back(std::move(made));
    }
}

void XmlReader::tiles(const xml_node& data, const Layer& layer, const std::string& encoding,
                      const std::string& compression, Cells& cells) {
    const std::string where = xml_.line(data) + "layer '" + layer.name + "': ";
    if (defects.first || !budget_.take_tiles(cells, where, defects)) return;
    const std::size_t count = std::size_t{cells.columns} * cells.rows;
    if (encoding.empty()) {
        for (const xml_node& tile : data.children("tile")) cells.gids.push_back(fields(tile).count("gid", 0, defects));
        if (cells.gids.size() != count)
            defects.fail(ProblemCode::bad_format, where + std::to_string(cells.gids.size()) + " tiles, where " +
                                                      std::to_string(count) + " were expected");
        return;
    }
    if (encoding != "csv" && encoding != "base64")
        return defects.fail(ProblemCode::bad_format, where + "unknown encoding '" + encoding + "'");
    Result<std::vector<std::uint32_t>> gids = encoding == "csv"
                                                  ? cells_from_csv(data.child_value(), count)
                                                  : cells_from_base64(data.child_value(), compression, count);
    if (!gids) return defects.fail(gids.problem().code, where + gids.problem().message);
    cells.gids = *std::move(gids);
}

void XmlReader::tile_layer(const xml_node& node, Layer& layer) {
    constexpr std::int64_t farthest = 1 << 30;
    const xml_node data = node.child("data");
    const std::string encoding = data.attribute("encoding").value(),
                      compression = data.attribute("compression").value();
    if (!data) return fail(node, "layer '" + layer.name + "': no data");
    if (!data.child("chunk")) {
        Cells cells;
        cells.columns = fields(node).count("width", map_->columns, defects);
        cells.rows = fields(node).count("height", map_->rows, defects);
        // An empty infinite map has no chunks.
        if (fields(xml_.root()).text("infinite") == "1") return;
        tiles(data, layer, encoding, compression, cells);
        layer.cells.push_back(std::move(cells));
        return;
    }
    for (const xml_node& chunk : data.children("chunk")) {
        Cells cells;
        const XmlFields of_chunk = fields(chunk);
        cells.column = static_cast<std::int32_t>(of_chunk.whole("x", 0, -farthest, farthest, defects));
        cells.row = static_cast<std::int32_t>(of_chunk.whole("y", 0, -farthest, farthest, defects));
        cells.columns = of_chunk.count("width", 0, defects);
        cells.rows = of_chunk.count("height", 0, defects);
        tiles(chunk, layer, encoding, compression, cells);
        layer.cells.push_back(std::move(cells));
    }
}

void XmlReader::layers(const xml_node& node, std::vector<Layer>& to, int depth) {
    if (depth > max_group_depth)
        return defects.fail(ProblemCode::too_large, xml_.line(node) + "groups are nested more than 64 deep");
    for (const xml_node& child : node.children()) {
        const std::string_view name = child.name();
        if (name != "layer"sv && name != "objectgroup"sv && name != "imagelayer"sv && name != "group"sv) continue;
        Layer layer;
        read_layer(fields(child), layer, defects);
        properties(child, layer.properties);
        if (name == "layer"sv) {
            layer.kind = LayerKind::tiles;
            tile_layer(child, layer);
        } else if (name == "objectgroup"sv) {
            layer.kind = LayerKind::objects;
            objects(child, layer.objects);
        } else if (name == "imagelayer"sv) {
            layer.kind = LayerKind::image;
        } else {
            layers(child, layer.layers, depth + 1);
        }
        if (defects.first) return;
        to.push_back(std::move(layer));
    }
}

void XmlReader::tileset(const xml_node& node, Tileset& to) {
    read_tileset(fields(node), to, defects);
    const XmlFields offset = fields(node.child("tileoffset"));
    to.offset = {offset.number("x", 0, defects), offset.number("y", 0, defects)};
    for (const xml_node& child : node.children("tile")) {
        const XmlFields of_tile = fields(child);
        TileData& tile = to.tiles[of_tile.count("id", 0, defects)];
        read_type(of_tile, tile.type);
        properties(child, tile.properties);
        const XmlFields image = fields(child.child("image"));
        tile.size = {image.number("width", 0, defects), image.number("height", 0, defects)};
        tile.size = {of_tile.number("width", tile.size.x, defects), of_tile.number("height", tile.size.y, defects)};
        objects(child.child("objectgroup"), tile.shapes);
        if (defects.first) return;
    }
}

void XmlReader::map(const xml_node& node) {
    read_map(fields(node), *map_, defects);
    for (const xml_node& one : node.children("tileset")) {
        if (defects.first) return;
        const std::uint32_t first = fields(one).count("firstgid", 1, defects);
        if (const pugi::xml_attribute source = one.attribute("source")) {
            add_tileset(resolved_path("", source.value()), first, *map_, *files_, xml_.line(one), defects);
            continue;
        }
        Tileset made;
        made.first_gid = first;
        tileset(one, made);
        map_->tilesets.push_back(std::move(made));
    }
    if (!defects.first) layers(node, map_->layers, 0);
}

void XmlReader::object_template(const xml_node& node, Template& to) {
    const xml_node set = node.child("tileset");
    to.first_gid = fields(set).count("firstgid", 1, defects);
    to.tileset_file = set.attribute("source").value();
    object(node.child("object"), to.object);
}

// Reads a document with this root element.
template <class T, class Read>
Result<T> read(std::span<const std::byte> bytes, const char* element, Files* files, Read read_it) {
    const Result<std::unique_ptr<detail::Xml>> xml = detail::Xml::parse(bytes);
    if (!xml) return xml.problem();
    const xml_node root = (*xml)->root();
    if (std::string_view(root.name()) != element)
        return Problem{ProblemCode::bad_format,
                       std::string("<") + element + "> was expected, and there is <" + root.name() + ">"};
    T result;
    Map* map = nullptr;
    if constexpr (std::is_same_v<T, Map>) map = &result;
    XmlReader reader(**xml, map, files);
    read_it(reader, root, result);
    if (reader.defects.first) return *reader.defects.first;
    return result;
}

}  // namespace

Result<Map> map_from_xml(std::span<const std::byte> bytes, Files& files) {
    return read<Map>(bytes, "map", &files, [](XmlReader& reader, const xml_node& root, Map&) { reader.map(root); });
}

Result<Tileset> tileset_from_xml(std::span<const std::byte> bytes) {
    return read<Tileset>(bytes, "tileset", nullptr, [](XmlReader& reader, const xml_node& root, Tileset& tileset) {
        reader.tileset(root, tileset);
    });
}

Result<Template> template_from_xml(std::span<const std::byte> bytes) {
    return read<Template>(bytes, "template", nullptr, [](XmlReader& reader, const xml_node& root, Template& made) {
        reader.object_template(root, made);
    });
}

}  // namespace abut::tiled
