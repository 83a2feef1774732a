#include <abut/io/file/decompress.hpp>
#include <abut/io/file/read_file.hpp>
#include <abut/io/file/referenced_files.hpp>
#include <abut/io/file/scanner.hpp>
#include <abut/io/file/size_limit.hpp>
#include <abut/io/read_level.hpp>
#include <abut/io/svg/read_svg.hpp>
#include <abut/io/tiled/read_tiled.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut {

using namespace detail;

namespace {

// The parsed tree takes about ten times as much memory as the text.
constexpr std::size_t max_bytes = std::size_t{256} << 20;

bool is_gzip(std::span<const std::byte> bytes) {
    return bytes.size() > 2 && bytes[0] == std::byte{0x1f} && bytes[1] == std::byte{0x8b};
}

}  // namespace

bool is_level(const std::filesystem::path& file) {
    const std::string extension = lower_case(file.extension().string());
    for (const char* known : {".tmx", ".tmj", ".json", ".svg", ".svgz"})
        if (extension == known) return true;
    return false;
}

Result<Level> read_level(std::span<const std::byte> bytes, std::string_view extension, tiled::OpenFile open,
                         const LevelOptions& options) {
    const std::string ending = lower_case(std::string(extension));
    if (bytes.empty()) return Problem{ProblemCode::empty_input, "is empty"};
    if (std::optional<Problem> problem = check_size(bytes.size(), max_bytes)) return *std::move(problem);
    if (options.tolerance && !(*options.tolerance > 0))
        return Problem{ProblemCode::bad_argument, "the tolerance must be above zero"};
    if (ending == ".tmx" || ending == ".tmj" || ending == ".json")
        return read_tiled(bytes, open, options.allow_outside);
    if (ending != ".svg" && ending != ".svgz")
        return Problem{ProblemCode::bad_format, "'" + ending + "' is not a known format of levels"};
    if (!is_gzip(bytes)) return read_svg(bytes, options.tolerance);
    const Result<std::vector<std::byte>> whole = decompress_zlib(bytes, max_bytes);
    if (!whole) return whole.problem();
    return read_svg(*whole, options.tolerance);
}

Result<Level> read_level(const std::filesystem::path& file, const LevelOptions& options) {
    const Result<std::vector<std::byte>> bytes = read_file(file, max_bytes);
    if (!bytes) return bytes.problem();
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    const ReferencedFiles files(folder, options.allow_outside);
    const auto open = [&](const std::string& name) -> Result<std::vector<std::byte>> {
        const Result<std::filesystem::path> path = files.find(name);
        if (!path) return path.problem();
        return read_file(*path, max_bytes);
    };
    return read_level(*bytes, file.extension().string(), open, options);
}

}  // namespace abut
