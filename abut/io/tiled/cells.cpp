#include <abut/io/file/base64.hpp>
#include <abut/io/file/decompress.hpp>
#include <abut/io/tiled/cells.hpp>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <span>
#include <string>
#include <system_error>
#include <utility>

namespace abut::tiled {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

Result<std::vector<std::byte>> decompressed(std::vector<std::byte> bytes, std::string_view compression,
                                            std::size_t max_bytes) {
    if (compression.empty()) return bytes;
    if (compression == "zlib" || compression == "gzip") return detail::decompress_zlib(bytes, max_bytes);
    if (compression == "zstd") return detail::decompress_zstd(bytes, max_bytes);
    return Problem{ProblemCode::bad_format, "unknown compression '" + std::string(compression) + "'"};
}

Problem count_problem(std::size_t found, std::size_t count) {
    return {ProblemCode::bad_format,
            std::to_string(found) + " tiles, where " + std::to_string(count) + " were expected"};
}

}  // namespace

Result<std::vector<std::uint32_t>> cells_from_csv(std::string_view text, std::size_t count) {
    std::vector<std::uint32_t> result;
    const char *at = text.data(), *const end = text.data() + text.size();
    const auto skip_blanks = [&] {
        while (at != end && is_blank(*at)) ++at;
    };
    for (skip_blanks(); at != end; skip_blanks()) {
        std::uint32_t gid = 0;
        const auto [stopped, error] = std::from_chars(at, end, gid);
        if (error != std::errc())
            return Problem{ProblemCode::bad_format, "tile " + std::to_string(result.size()) + ": a number was expected",
                           result.size()};
        if (result.size() == count) return count_problem(count + 1, count);
        result.push_back(gid);
        at = stopped;
        skip_blanks();
        if (at == end) break;
        if (*at != ',')
            return Problem{ProblemCode::bad_format,
                           "tile " + std::to_string(result.size() - 1) + ": a comma was expected after it",
                           result.size() - 1};
        ++at;
    }
    if (result.size() != count) return count_problem(result.size(), count);
    return result;
}

Result<std::vector<std::uint32_t>> cells_from_base64(std::string_view text, std::string_view compression,
                                                     std::size_t count) {
    std::string digits;
    std::copy_if(text.begin(), text.end(), std::back_inserter(digits), [](char c) { return !is_blank(c); });
    Result<std::vector<std::byte>> encoded = detail::decode_base64(digits);
    if (!encoded) return encoded.problem();
    const Result<std::vector<std::byte>> bytes = decompressed(*std::move(encoded), compression, 4 * count);
    if (!bytes) return bytes.problem();
    if (bytes->size() != 4 * count)
        return Problem{ProblemCode::bad_format, std::to_string(bytes->size()) + " bytes of tiles, where " +
                                                    std::to_string(4 * count) + " were expected"};
    std::vector<std::uint32_t> result(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t byte = 0; byte < 4; ++byte)
            result[i] |= std::to_integer<std::uint32_t>((*bytes)[4 * i + byte]) << (8 * byte);
    return result;
}

}  // namespace abut::tiled
