// The readers of levels on any bytes: a Level that is safe to query, or a Problem with a message. Files that a map
// refers to are the map itself, so that the readers of tilesets and templates run too.

#include "bytes.hpp"
#include <abut/io/read_level.hpp>
#include <abut/query/closest.hpp>

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace abut;
using fuzz::require;

// The format is chosen by the text, as in the corpus.
std::string_view extension_of(std::string_view text) {
    if (text.starts_with("{")) return ".tmj";
    if (text.starts_with("\x1f\x8b")) return ".svgz";
    return text.find("<svg") == std::string_view::npos ? ".tmx" : ".svg";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
    const auto itself = [&](const std::string&) -> Result<std::vector<std::byte>> {
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    };
    const std::string_view extension = extension_of({reinterpret_cast<const char*>(data), size});
    const Result<Level> level = read_level(bytes, extension, itself);
    if (!level) {
        require(!level.problem().message.empty());
        return 0;
    }
    std::set<std::string> paths;
    for (const LevelObject& object : level->objects) {
        require(paths.insert(object.path).second);
        require(count_parts(object.shape) > 0 && !kind(object.shape).empty());
        const Aabb2 box = bounds(object);
        require(!(box.min.x > box.max.x) && !(box.min.y > box.max.y));
        const Closest<2> answer = closest(object, Vec2(3, 4));
        require(!(answer.distance != answer.distance));
    }
    for (const LevelPoint& point : level->points)
        require(paths.insert(point.path).second && detail::is_finite(point.position));
    return 0;
}
