#include <abut/io/finish_level.hpp>
#include <abut/io/tiled/grid.hpp>
#include <abut/io/tiled/read_tiled.hpp>
#include <abut/io/tiled/tiles.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace abut::detail {
namespace {

using namespace tiled;

// Limit on tiles of a layer whose shapes become children of a compound.
constexpr std::size_t max_own_shapes = std::size_t{1} << 18;

// A half-open range of columns and rows.
struct Extent {
    std::int64_t first_column = std::numeric_limits<std::int64_t>::max(), first_row = first_column;
    std::int64_t end_column = std::numeric_limits<std::int64_t>::min(), end_row = end_column;

    bool any() const { return first_column < end_column; }
    void include(std::int64_t column, std::int64_t row) {
        first_column = std::min(first_column, column);
        first_row = std::min(first_row, row);
        end_column = std::max(end_column, column + 1);
        end_row = std::max(end_row, row + 1);
    }
    std::uint64_t columns() const { return static_cast<std::uint64_t>(end_column - first_column); }
    std::uint64_t rows() const { return static_cast<std::uint64_t>(end_row - first_row); }
};

// The anchor of a tile object in its rectangle, from the low corner, as fractions of its size.
DVec<2> anchor(const Tileset* tileset) {
    const std::string alignment = tileset == nullptr ? "unspecified" : tileset->alignment;
    if (alignment == "unspecified") return {0, 1};
    const auto has = [&](const char* word) { return alignment.find(word) != std::string::npos; };
    return {has("left") ? 0 : has("right") ? 1 : 0.5, has("top") ? 0 : has("bottom") ? 1 : 0.5};
}

class Builder {
public:
    explicit Builder(const Map& map) : map_(map), tiles_(map) {}

    Result<Level> build();

private:
    void fail(const std::string& path, const Problem& problem) {
        if (!problem_) problem_ = Problem{problem.code, "'" + path + "': " + problem.message};
    }
    template <class Named>
    Named named(const std::string& prefix, const Object& object) const;

    void layers(const std::vector<Layer>& layers, const std::string& prefix, const DVec<2>& offset);
    void tile_layer(const Layer& layer, const std::string& prefix, const DVec<2>& offset);
    void object(const Object& object, const std::string& prefix, const DVec<2>& offset);
    Result<PlacedShape> shape_of(const Object& object, const DVec<2>& offset) const;

    const Map& map_;
    Tiles tiles_;
    Level level_;
    LeftOut left_out_;
    bool uses_all_tiles_ = false;
    std::optional<Problem> problem_;
};

// An object without a name is named by its class and the id that the editor shows. A tile object inherits its tile's
// class and properties.
template <class Named>
Named Builder::named(const std::string& prefix, const Object& object) const {
    Named named_thing;
    named_thing.type = object.type;
    named_thing.properties = object.properties;
    if (const TileData* tile = object.gid == 0 ? nullptr : tiles_.tile_of(object.gid)) {
        if (named_thing.type.empty()) named_thing.type = tile->type;
        for (const LevelProperty& inherited : tile->properties)
            if (property(named_thing.properties, inherited.name) == nullptr)
                named_thing.properties.push_back(inherited);
    }
    named_thing.name = object.name;
    if (named_thing.name.empty())
        named_thing.name = (named_thing.type.empty() ? "object" : named_thing.type) + " " + std::to_string(object.id);
    named_thing.path = prefix + named_thing.name;
    return named_thing;
}

Result<PlacedShape> Builder::shape_of(const Object& object, const DVec<2>& offset) const {
    if (object.gid == 0) return place_object(translation_by(offset), object);
    const Affine<2> place = translation_by(offset) * translation_by(object.position) * rotation_by(object.rotation);
    const DVec<2> to_low = -anchor(tiles_.tileset_of(object.gid)) * object.size;
    Result<std::vector<PlacedShape>> shapes = tiles_.shown(object.gid, object.size, place * translation_by(to_low));
    if (!shapes) return shapes.problem();
    return join_shapes(*std::move(shapes));
}

void Builder::object(const Object& object, const std::string& prefix, const DVec<2>& offset) {
    const bool is_plain = object.gid == 0 && object.form == Form::rectangle;
    if (object.form == Form::point || (is_plain && object.size == DVec<2>(0))) {
        LevelPoint point = named<LevelPoint>(prefix, object);
        point.position = to_float(object.position + offset);
        if (!is_finite(point.position))
            return fail(point.path, {ProblemCode::not_finite, "a coordinate is out of the range of floats"});
        level_.points.push_back(std::move(point));
        return;
    }
    LevelObject made = named<LevelObject>(prefix, object);
    if (object.form == Form::text) return left_out_.add("text is", "texts are", "left out", made.path);
    Result<PlacedShape> shape = shape_of(object, offset);
    if (!shape && shape.problem().code == ProblemCode::degenerate)
        return left_out_.add("object is", "objects are", "left out, without extent", made.path);
    if (!shape) return fail(made.path, shape.problem());
    made.shape = std::move(shape->shape);
    made.pose = shape->pose;
    made.filled = shape->filled;
    level_.objects.push_back(std::move(made));
}

void Builder::tile_layer(const Layer& layer, const std::string& prefix, const DVec<2>& offset) {
    const std::string path = prefix + layer.name;
    // A map of known size keeps its cell numbers; an infinite map is reduced to the extent of its tiles.
    Extent extent;
    bool is_chunked = layer.cells.size() != 1;
    for (const Cells& cells : layer.cells) is_chunked = is_chunked || cells.column != 0 || cells.row != 0;
    std::size_t own_shapes = 0;
    bool has_kinds = false;
    const auto each_tile = [&](auto visit) {
        for (const Cells& cells : layer.cells)
            for (std::size_t i = 0; i < cells.gids.size(); ++i) {
                if ((cells.gids[i] & ~all_flips) == 0) continue;
                const Result<const TileCollision*> collision = tiles_.collision(cells.gids[i]);
                if (!collision) return fail(path, collision.problem());
                visit(cells.column + static_cast<std::int64_t>(i % cells.columns),
                      cells.row + static_cast<std::int64_t>(i / cells.columns), **collision);
            }
    };
    bool has_tiles = false;
    each_tile([&](std::int64_t column, std::int64_t row, const TileCollision& collision) {
        has_tiles = true;
        own_shapes += collision.shapes.size();
        if (collision.kind == Tile::empty) return;
        has_kinds = true;
        extent.include(column, row);
    });
    if (problem_ || !has_tiles) return;
    if (!has_kinds && own_shapes == 0)
        return left_out_.add("tile layer is", "tile layers are", "left out: none of their tiles has a collision shape",
                             path);
    if (own_shapes > max_own_shapes)
        return fail(path, {ProblemCode::too_large, std::to_string(own_shapes) +
                                                       " tiles have shapes that are neither full, half, slope nor "
                                                       "one-way; the limit is " +
                                                       std::to_string(max_own_shapes)});
    if (!tiles_.have_shapes()) uses_all_tiles_ = true;

    std::vector<PlacedShape> shapes;
    if (has_kinds) {
        if (!is_chunked) extent = {0, 0, layer.cells[0].columns, layer.cells[0].rows};
        if (extent.columns() > max_tiles / extent.rows())
            return fail(path, {ProblemCode::too_large, "its tiles are spread over " + std::to_string(extent.columns()) +
                                                           " x " + std::to_string(extent.rows()) + " cells"});
        std::vector<Tile> grid(extent.columns() * extent.rows(), Tile::empty);
        each_tile([&](std::int64_t column, std::int64_t row, const TileCollision& collision) {
            if (collision.kind == Tile::empty) return;
            const auto x = static_cast<std::uint64_t>(column - extent.first_column);
            const auto y = static_cast<std::uint64_t>(row - extent.first_row);
            grid[x + y * extent.columns()] = collision.kind;
        });
        Result<TileMap> built = TileMap::build(grid, static_cast<std::uint32_t>(extent.columns()), Vec2(map_.cell));
        if (!built) return fail(path, built.problem());
        const DVec<2> first(static_cast<double>(extent.first_column), static_cast<double>(extent.first_row));
        shapes.push_back({*std::move(built), {to_float(offset + first * map_.cell), {}}, false});
    }
    if (own_shapes > 0)
        each_tile([&](std::int64_t column, std::int64_t row, const TileCollision& collision) {
            const Pose2 place{to_float(offset + cell_position(map_, column, row)), {}};
            for (const PlacedShape& shape : collision.shapes)
                shapes.push_back({shape.shape, place * shape.pose, shape.filled});
        });
    Result<PlacedShape> whole = join_shapes(std::move(shapes));
    if (!whole) return fail(path, whole.problem());
    LevelObject made;
    made.name = layer.name;
    made.path = path;
    made.type = layer.type;
    made.properties = layer.properties;
    made.shape = std::move(whole->shape);
    made.pose = whole->pose;
    made.filled = whole->filled;
    made.is_layer = true;
    made.assumed_full = !tiles_.have_shapes();
    level_.objects.push_back(std::move(made));
}

void Builder::layers(const std::vector<Layer>& layers, const std::string& prefix, const DVec<2>& outer) {
    for (const Layer& layer : layers) {
        if (problem_) return;
        const std::string path = prefix + layer.name;
        const DVec<2> offset = outer + layer.offset;
        if (layer.parallax != DVec<2>(1))
            left_out_.add("layer has", "layers have", "a parallax, which is ignored", path);
        if (!layer.visible && layer.kind != LayerKind::image)
            left_out_.add("layer is", "layers are", "hidden in the editor, but read", path);
        switch (layer.kind) {
            case LayerKind::tiles:
                tile_layer(layer, prefix, offset);
                break;
            case LayerKind::objects:
                for (const Object& one : layer.objects) object(one, path + "/", offset);
                break;
            case LayerKind::group:
                this->layers(layer.layers, path + "/", offset);
                break;
            case LayerKind::image:
                left_out_.add("image layer is", "image layers are", "left out", path);
                break;
        }
    }
}

Result<Level> Builder::build() {
    layers(map_.layers, "", DVec<2>(0));
    if (problem_) return *problem_;
    level_.warnings = left_out_.lines();
    if (map_.is_isometric)
        level_.warnings.push_back(
            "the map is isometric: positions are on the ground, where a cell is a square, and tiles with shapes are "
            "full");
    if (uses_all_tiles_) level_.warnings.push_back("no tileset has collision shapes: every tile is taken as full");
    return std::move(level_);
}

}  // namespace

Result<Level> read_tiled(std::span<const std::byte> bytes, OpenFile open, bool allow_outside) {
    Files files(open, allow_outside);
    const Result<Map> map = is_xml(bytes) ? map_from_xml(bytes, files) : map_from_json(bytes, files);
    if (!map) return map.problem();
    Result<Level> level = Builder(*map).build();
    if (!level) return level;
    return finish_level(*std::move(level));
}

}  // namespace abut::detail
