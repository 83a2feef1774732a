#pragma once

// Reads the maps of a Doom WAD as 2D levels, seen from above.

#include "little_endian.hpp"
#include <abut/math/vec.hpp>

#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include <glm/ext/vector_uint2.hpp>

namespace abut::scenes {

struct WadMap {
    std::string name;
    std::vector<Vec2> points;
    std::vector<glm::uvec2> one_sided;  ///< walls: the outside is to the left of each
    std::vector<glm::uvec2> lines;      ///< of all kinds
    std::vector<glm::uvec2> barriers;   ///< two-sided lines that block the player
    std::vector<glm::uvec2>
        ledges;  ///< two-sided lines passable from left to right only: a step down that is too high to climb
    std::optional<Vec2> start;  ///< of the first player
    std::size_t nodes = 0;      ///< count of nodes of the map's own BSP tree
};

namespace detail {

struct WadChunk {
    std::size_t at = 0, size = 0;
};

/// True for names such as E1M1 or MAP01.
inline bool names_a_map(const std::string& name) {
    const auto digit = [&](std::size_t i) { return std::isdigit(static_cast<unsigned char>(name[i])) != 0; };
    return (name.size() == 4 && name[0] == 'E' && digit(1) && name[2] == 'M' && digit(3)) ||
           (name.size() == 5 && name.substr(0, 3) == "MAP" && digit(3) && digit(4));
}

/// The data chunks of one map, which the file format calls lumps.
struct WadMapChunks {
    enum Kind { things, lines, sides, points, sectors, nodes, kinds };
    static constexpr std::array<const char*, kinds> names{"THINGS",   "LINEDEFS", "SIDEDEFS",
                                                          "VERTEXES", "SECTORS",  "NODES"};
    static constexpr std::array<std::size_t, kinds> sizes{10, 14, 30, 4, 26, 28};  // bytes per record

    std::string name;
    std::array<std::optional<WadChunk>, kinds> chunks;

    std::size_t count(Kind kind) const { return chunks[kind] ? chunks[kind]->size / sizes[kind] : 0; }
    std::size_t place(Kind kind, std::size_t i) const { return chunks[kind]->at + i * sizes[kind]; }
};

/// Size of the game's player: the highest step up, and the lowest opening.
constexpr int wad_step = 24, wad_height = 56;

struct WadFloor {
    int floor = 0, ceiling = 0;
};

/// The floor of the sector on a side of a line; none if an index is invalid.
inline std::optional<WadFloor> floor_beside(const LittleEndian& bytes, const WadMapChunks& map, std::uint32_t side) {
    if (side >= map.count(WadMapChunks::sides)) return std::nullopt;
    const std::uint32_t sector = bytes.u16(map.place(WadMapChunks::sides, side) + 28);
    if (sector >= map.count(WadMapChunks::sectors)) return std::nullopt;
    const std::size_t at = map.place(WadMapChunks::sectors, sector);
    return WadFloor{bytes.i16(at), bytes.i16(at + 2)};
}

/// Returns false if a line has an invalid index.
inline bool read_lines(const LittleEndian& bytes, const WadMapChunks& chunks, WadMap& map) {
    constexpr std::uint32_t none = 0xffff, blocks = 1;
    for (std::size_t i = 0; i < chunks.count(WadMapChunks::lines); ++i) {
        const std::size_t at = chunks.place(WadMapChunks::lines, i);
        const glm::uvec2 line(bytes.u16(at), bytes.u16(at + 2));
        if (line.x >= map.points.size() || line.y >= map.points.size()) return false;
        map.lines.push_back(line);
        const std::uint32_t flags = bytes.u16(at + 4), does = bytes.u16(at + 6), left = bytes.u16(at + 12);
        if (left == none) {
            map.one_sided.push_back(line);
            continue;
        }
        const auto on_right = floor_beside(bytes, chunks, bytes.u16(at + 10)),
                   on_left = floor_beside(bytes, chunks, left);
        if (!on_right || !on_left) return false;
        if (flags & blocks) map.barriers.push_back(line);
        // Doors and lifts are such lines: they count as open.
        if (flags & blocks || does != 0) continue;
        const int step = on_left->floor - on_right->floor;
        const int opening = std::min(on_left->ceiling, on_right->ceiling) - std::max(on_left->floor, on_right->floor);
        if (opening < wad_height)
            map.barriers.push_back(line);
        else if (std::abs(step) > wad_step)
            map.ledges.push_back(step > 0 ? line : glm::uvec2(line.y, line.x));
    }
    return true;
}

inline std::optional<WadMap> read_map(const LittleEndian& bytes, const WadMapChunks& chunks) {
    WadMap map;
    map.name = chunks.name;
    map.nodes = chunks.count(WadMapChunks::nodes);
    const auto point = [&](std::size_t at) {
        return Vec2(static_cast<float>(bytes.i16(at)), static_cast<float>(bytes.i16(at + 2)));
    };
    for (std::size_t i = 0; i < chunks.count(WadMapChunks::points); ++i)
        map.points.push_back(point(chunks.place(WadMapChunks::points, i)));
    constexpr std::uint32_t first_player = 1;
    for (std::size_t i = 0; i < chunks.count(WadMapChunks::things); ++i) {
        const std::size_t at = chunks.place(WadMapChunks::things, i);
        if (bytes.u16(at + 6) == first_player) map.start = point(at);
    }
    if (!read_lines(bytes, chunks, map)) return std::nullopt;
    return map;
}

}  // namespace detail

/// All maps, in file order.
inline Result<std::vector<WadMap>> wad_maps(const std::string& name, std::vector<char> content) {
    const LittleEndian bytes(std::move(content));
    constexpr std::size_t entry_size = 16;
    const Problem bad{ProblemCode::bad_format, name + ": not a WAD"};
    if (!bytes.holds(0, 12)) return bad;
    const std::string_view kind = "WAD";
    for (std::size_t i = 0; i < kind.size(); ++i)
        if (bytes.byte(i + 1) != static_cast<unsigned char>(kind[i])) return bad;
    const std::size_t count = bytes.u32(4), directory = bytes.u32(8);
    if (!bytes.holds(directory, count * entry_size)) return bad;

    std::vector<detail::WadMapChunks> found;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t entry = directory + i * entry_size;
        const detail::WadChunk chunk{bytes.u32(entry), bytes.u32(entry + 4)};
        const std::string chunk_name = bytes.text(entry + 8, 8);
        if (!bytes.holds(chunk.at, chunk.size))
            return Problem{ProblemCode::bad_format, name + ": " + chunk_name + " is beyond its end", entry};
        if (detail::names_a_map(chunk_name)) found.push_back({chunk_name, {}});
        for (std::size_t k = 0; k < detail::WadMapChunks::kinds; ++k)
            if (!found.empty() && chunk_name == detail::WadMapChunks::names[k] && !found.back().chunks[k])
                found.back().chunks[k] = chunk;
    }
    std::vector<WadMap> maps;
    for (const detail::WadMapChunks& chunks : found) {
        std::optional<WadMap> map = detail::read_map(bytes, chunks);
        if (!map)
            return Problem{ProblemCode::index_out_of_range, name + ": a line of " + chunks.name + " names nothing"};
        maps.push_back(*std::move(map));
    }
    return maps;
}
inline Result<std::vector<WadMap>> read_wad(const std::string& path) {
    Result<std::vector<char>> bytes = read_bytes(path);
    if (!bytes) return bytes.problem();
    return wad_maps(path, *std::move(bytes));
}

}  // namespace abut::scenes
