// The data of a height field: the columns of heights, the size of a cell, the numbers of heights and of bytes with
// holes, the heights, and one bit a cell that is set for a hole, if there are any. Of a tile map: the columns, the size
// of a tile, their number, and the tiles. Of a voxel map: the numbers of voxels, the size of a voxel, the number of
// words, and the words with one bit a voxel. The blocks over their cells are computed, which takes no longer than to
// check them.

#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/file/blob.hpp>

#include <optional>
#include <utility>

namespace abut {

using namespace detail;

namespace {

/// One bit a cell; empty if there are no holes.
std::vector<std::uint8_t> holes_of(const HeightField& field) {
    const std::uint32_t cells = field.size() / 2;
    std::vector<std::uint8_t> bits((std::size_t{cells} + 7) / 8);
    bool any = false;
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
        if (!field.is_hole(cell)) continue;
        any = true;
        bits[cell / 8] = static_cast<std::uint8_t>(bits[cell / 8] | 1 << cell % 8);
    }
    if (!any) bits.clear();
    return bits;
}

}  // namespace

std::vector<std::byte> save(const HeightField& field) {
    const std::vector<std::uint8_t> holes = holes_of(field);
    BlobWriter writer = begin_shape(SavedKind::height_field, 64 + field.heights().size_bytes() + holes.size());
    writer.number(field.columns());
    writer.number(field.cell().x);
    writer.number(field.cell().y);
    writer.number(static_cast<std::uint64_t>(field.heights().size()));
    writer.number(static_cast<std::uint64_t>(holes.size()));
    writer.array(field.heights());
    writer.array(std::span(holes));
    return end_shape(std::move(writer));
}

Result<HeightField> load_height_field(std::span<const std::byte> bytes) {
    enter_library();
    constexpr SavedKind kind = SavedKind::height_field;
    std::uint32_t columns = 0;
    Vec2 cell{};
    std::uint64_t heights = 0, hole_bytes = 0;
    std::vector<float> height;
    std::vector<std::uint8_t> bits;
    const auto read = [&](BlobReader& reader) {
        return reader.number(columns) && reader.number(cell.x) && reader.number(cell.y) && reader.number(heights) &&
               reader.number(hole_bytes) && reader.array(height, heights) && reader.array(bits, hole_bytes);
    };
    if (std::optional<Problem> wrong = read_shape(bytes, kind, read)) return *std::move(wrong);
    std::vector<std::uint32_t> holes;
    for (std::size_t i = 0; i < bits.size(); ++i)
        for (std::uint32_t bit = 0; bit < 8; ++bit)
            if ((bits[i] >> bit & 1) != 0) holes.push_back(static_cast<std::uint32_t>(8 * i + bit));
    if (holes.empty() != bits.empty()) return bad_shape(kind, "has an empty list of holes");
    Result<HeightField> built = HeightField::build(height, columns, cell, {.holes = holes});
    if (built && !bits.empty() && bits.size() != (std::size_t{built->size()} / 2 + 7) / 8)
        return bad_shape(kind, "has a list of holes for another number of cells");
    return built;
}

std::vector<std::byte> save(const TileMap& map) {
    BlobWriter writer = begin_shape(SavedKind::tile_map, 64 + map.tiles().size_bytes());
    writer.number(map.columns());
    writer.number(map.cell().x);
    writer.number(map.cell().y);
    writer.number(static_cast<std::uint64_t>(map.tiles().size()));
    writer.array(map.tiles());
    return end_shape(std::move(writer));
}

Result<TileMap> load_tile_map(std::span<const std::byte> bytes) {
    enter_library();
    std::uint32_t columns = 0;
    Vec2 cell{};
    std::uint64_t count = 0;
    std::vector<Tile> tiles;
    const auto read = [&](BlobReader& reader) {
        return reader.number(columns) && reader.number(cell.x) && reader.number(cell.y) && reader.number(count) &&
               reader.array(tiles, count);
    };
    if (std::optional<Problem> wrong = read_shape(bytes, SavedKind::tile_map, read)) return *std::move(wrong);
    return TileMap::build(tiles, columns, cell);
}

std::vector<std::byte> save(const VoxelMap& map) {
    BlobWriter writer = begin_shape(SavedKind::voxel_map, 64 + map.bits().size_bytes());
    for (int axis = 0; axis < 3; ++axis) writer.number(map.count()[axis]);
    for (int axis = 0; axis < 3; ++axis) writer.number(map.cell()[axis]);
    writer.number(static_cast<std::uint64_t>(map.bits().size()));
    writer.array(map.bits());
    return end_shape(std::move(writer));
}

Result<VoxelMap> load_voxel_map(std::span<const std::byte> bytes) {
    enter_library();
    glm::uvec3 count{};
    Vec3 cell{};
    std::uint64_t words = 0;
    std::vector<std::uint64_t> bits;
    const auto read = [&](BlobReader& reader) {
        bool whole = true;
        for (int axis = 0; axis < 3; ++axis) whole = whole && reader.number(count[axis]);
        for (int axis = 0; axis < 3; ++axis) whole = whole && reader.number(cell[axis]);
        return whole && reader.number(words) && reader.array(bits, words);
    };
    if (std::optional<Problem> wrong = read_shape(bytes, SavedKind::voxel_map, read)) return *std::move(wrong);
    Result<VoxelMap> built = VoxelMap::build(bits, count, cell);
    if (built && built->bits().back() != bits.back())
        return bad_shape(SavedKind::voxel_map, "has bits beyond its last voxel");
    return built;
}

}  // namespace abut
