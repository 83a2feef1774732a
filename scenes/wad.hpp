#pragma once

// The maps of a Doom WAD: walls in the plane, and how many nodes its own tree of planes has.

#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <glm/ext/vector_uint2.hpp>

namespace abut::scenes {

struct WadMap {
    std::string name;
    std::vector<Vec2> points;
    std::vector<glm::uvec2> one_sided;  ///< walls: the void is to the left of each
    std::vector<glm::uvec2> lines;      ///< of all kinds
    std::size_t nodes = 0;              ///< of the map's own tree, of all lines
};

namespace detail {

class WadBytes {
public:
    explicit WadBytes(std::vector<char> bytes) : bytes_(std::move(bytes)) {}

    bool holds(std::size_t at, std::size_t count) const { return at <= bytes_.size() && count <= bytes_.size() - at; }
    std::uint32_t byte(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }
    std::uint32_t u16(std::size_t at) const { return byte(at) | byte(at + 1) << 8; }
    std::uint32_t u32(std::size_t at) const { return u16(at) | u16(at + 2) << 16; }
    float i16(std::size_t at) const { return static_cast<float>(static_cast<std::int16_t>(u16(at))); }
    std::string name(std::size_t at) const {
        const std::string_view text(bytes_.data() + at, 8);
        return std::string(text.substr(0, text.find('\0')));
    }

private:
    std::vector<char> bytes_;
};

struct WadLump {
    std::size_t at, size;
    std::string name;
};

/// E1M1 or MAP01.
inline bool names_a_map(const std::string& name) {
    const auto digit = [&](std::size_t i) { return std::isdigit(static_cast<unsigned char>(name[i])) != 0; };
    return (name.size() == 4 && name[0] == 'E' && digit(1) && name[2] == 'M' && digit(3)) ||
           (name.size() == 5 && name.substr(0, 3) == "MAP" && digit(3) && digit(4));
}

}  // namespace detail

/// In the order of the file.
inline Result<std::vector<WadMap>> read_wad(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return Problem{ProblemCode::not_found, path + ": no such file"};
    const detail::WadBytes bytes({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
    constexpr std::size_t entry_size = 16;
    const Problem bad{ProblemCode::bad_format, path + ": not a WAD"};
    if (!bytes.holds(0, 12)) return bad;
    const std::string_view kind = "WAD";
    for (std::size_t i = 0; i < kind.size(); ++i)
        if (bytes.byte(i + 1) != static_cast<unsigned char>(kind[i])) return bad;
    const std::size_t count = bytes.u32(4), directory = bytes.u32(8);
    if (!bytes.holds(directory, count * entry_size)) return bad;

    std::vector<WadMap> maps;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t entry = directory + i * entry_size;
        const detail::WadLump lump{bytes.u32(entry), bytes.u32(entry + 4), bytes.name(entry + 8)};
        if (!bytes.holds(lump.at, lump.size)) return bad;
        if (detail::names_a_map(lump.name)) {
            maps.push_back({lump.name, {}, {}, {}, 0});
        } else if (!maps.empty() && lump.name == "LINEDEFS" && maps.back().lines.empty()) {
            constexpr std::size_t size = 14, none = 0xffff;
            for (std::size_t at = lump.at; at + size <= lump.at + lump.size; at += size) {
                maps.back().lines.emplace_back(bytes.u16(at), bytes.u16(at + 2));
                if (bytes.u16(at + 12) == none) maps.back().one_sided.push_back(maps.back().lines.back());
            }
        } else if (!maps.empty() && lump.name == "VERTEXES" && maps.back().points.empty()) {
            for (std::size_t at = lump.at; at + 4 <= lump.at + lump.size; at += 4)
                maps.back().points.emplace_back(bytes.i16(at), bytes.i16(at + 2));
        } else if (!maps.empty() && lump.name == "NODES") {
            maps.back().nodes = lump.size / 28;
        }
    }
    return maps;
}

}  // namespace abut::scenes
