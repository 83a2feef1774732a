#include <abut/io/gltf/container.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

namespace abut::gltf {
namespace {

constexpr std::uint32_t magic = 0x46546C67;         // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t binary_chunk = 0x004E4942;  // "BIN"
constexpr std::size_t chunk_header_size = 8;

// Little-endian; the caller has checked the length.
std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < 4; ++i) result |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
    return result;
}

std::string_view text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Problem truncated(std::size_t have, std::uint64_t need, const char* what) {
    return {ProblemCode::bad_format,
            std::string(what) + " is truncated: " + std::to_string(have) + " of " + std::to_string(need) + " bytes"};
}

// A version 1 container: a content length, the JSON, and the binary body up to the end.
Result<Container> open_version_1(std::span<const std::byte> bytes) {
    constexpr std::size_t header_size = 20;
    if (bytes.size() < header_size) return truncated(bytes.size(), header_size, "glTF container");
    const std::uint32_t content = word(bytes, 12);
    if (content > bytes.size() - header_size) return truncated(bytes.size() - header_size, content, "JSON chunk");
    return Container{text(bytes.subspan(header_size, content)), bytes.subspan(header_size + content)};
}

}  // namespace

bool is_container(std::span<const std::byte> bytes) {
    return bytes.size() >= 4 && word(bytes, 0) == magic;
}

Result<Container> open_container(std::span<const std::byte> bytes) {
    constexpr std::size_t header_size = 12;
    if (!is_container(bytes))
        return Problem{ProblemCode::bad_format, "not a binary glTF: it doesn't begin with 'glTF'"};
    if (bytes.size() < header_size) return truncated(bytes.size(), header_size, "glTF container");
    const std::uint32_t version = word(bytes, 4);
    const std::uint32_t length = word(bytes, 8);
    if (version != 1 && version != 2)
        return Problem{ProblemCode::bad_format, "glTF container has the unknown version " + std::to_string(version)};
    if (length > bytes.size()) return truncated(bytes.size(), length, "glTF container");
    if (length < header_size)
        return Problem{ProblemCode::bad_format, "glTF container gives its length as " + std::to_string(length)};
    bytes = bytes.first(length);
    if (version == 1) return open_version_1(bytes);

    Container container;
    bool has_json = false;
    std::size_t at = header_size;
    while (bytes.size() - at >= chunk_header_size) {
        const std::uint32_t chunk_length = word(bytes, at);
        const std::uint32_t type = word(bytes, at + 4);
        at += chunk_header_size;
        if (chunk_length > bytes.size() - at) return truncated(bytes.size() - at, chunk_length, "glTF chunk");
        const std::span<const std::byte> chunk = bytes.subspan(at, chunk_length);
        if (type == json_chunk && !has_json) {
            container.json = text(chunk);
            has_json = true;
        } else if (type == binary_chunk && container.binary.empty()) {
            container.binary = chunk;
        }
        at += chunk_length;
    }
    if (!has_json) return Problem{ProblemCode::bad_format, "glTF container has no JSON chunk"};
    return container;
}

}  // namespace abut::gltf
