#include "tool/shared/printable.hpp"

#include <cstdint>
#include <optional>

#include <fmt/format.h>

namespace abut::tool {
namespace {

struct CodePoint {
    std::uint32_t code = 0;
    std::size_t bytes = 1;
};

// The character at the start of the text; nothing if it isn't valid UTF-8.
std::optional<CodePoint> first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    if (byte(0) < 0x80) return CodePoint{byte(0), 1};
    const std::size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
    if (byte(0) < 0xc2 || byte(0) > 0xf4 || bytes > text.size()) return std::nullopt;
    std::uint32_t code = byte(0) & (0xffu >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return std::nullopt;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    const std::uint32_t least = bytes == 2 ? 0x80 : bytes == 3 ? 0x800 : 0x10000;
    const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < least || code > 0x10ffff || is_surrogate) return std::nullopt;
    return CodePoint{code, bytes};
}

bool is_control(std::uint32_t code) {
    return code < 0x20 || (code >= 0x7f && code <= 0x9f);
}

// Characters without width that reorder text or end its line (Unicode Annex 9, and 2028 and 2029).
bool reorders(std::uint32_t code) {
    return code == 0x061c || code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
           (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string printable(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::optional<CodePoint> next = first_character(text);
        const std::size_t bytes = next ? next->bytes : 1;
        if (!next)
            result += fmt::format("\\x{:02x}", static_cast<std::uint8_t>(text[0]));
        else if (is_control(next->code))
            result += fmt::format("\\x{:02x}", next->code);
        else if (reorders(next->code))
            result += fmt::format("\\u{:04x}", next->code);
        else
            result += text.substr(0, bytes);
        text.remove_prefix(bytes);
    }
    return result;
}

void make_printable(Scene& scene) {
    for (Geometry& geometry : scene.geometries) geometry.name = printable(geometry.name);
    for (SceneNode& node : scene.nodes) node.name = printable(node.name);
    for (Animation& animation : scene.animations) animation.name = printable(animation.name);
    for (std::string& warning : scene.warnings) warning = printable(warning);
}

void make_printable(Level& level) {
    const auto all = [](auto& named) {
        for (auto& each : named) {
            for (std::string* text : {&each.name, &each.path, &each.type}) *text = printable(*text);
            for (LevelProperty& property : each.properties) {
                property.name = printable(property.name);
                property.value = printable(property.value);
            }
        }
    };
    all(level.objects);
    all(level.points);
    for (std::string& warning : level.warnings) warning = printable(warning);
}

}  // namespace abut::tool
