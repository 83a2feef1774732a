#pragma once

// Reads little-endian numbers of a binary file.

#include <abut/math/result.hpp>

#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace abut::scenes {

/// All functions except `holds` require that the range is inside the bytes.
class LittleEndian {
public:
    explicit LittleEndian(std::vector<char> bytes) : bytes_(std::move(bytes)) {}

    std::size_t size() const { return bytes_.size(); }
    bool holds(std::size_t at, std::size_t count) const { return at <= bytes_.size() && count <= bytes_.size() - at; }
    std::uint32_t byte(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }
    std::uint32_t u16(std::size_t at) const { return byte(at) | byte(at + 1) << 8; }
    std::uint32_t u32(std::size_t at) const { return u16(at) | u16(at + 2) << 16; }
    std::int32_t i16(std::size_t at) const { return static_cast<std::int16_t>(u16(at)); }
    std::int32_t i32(std::size_t at) const { return static_cast<std::int32_t>(u32(at)); }
    float f32(std::size_t at) const { return std::bit_cast<float>(u32(at)); }
    /// Text up to the first zero byte, if there is one.
    std::string text(std::size_t at, std::size_t count) const {
        const std::string_view all(bytes_.data() + at, count);
        return std::string(all.substr(0, all.find('\0')));
    }

private:
    std::vector<char> bytes_;
};

inline Result<std::vector<char>> read_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return Problem{ProblemCode::not_found, path + ": no such file"};
    return std::vector<char>(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

}  // namespace abut::scenes
