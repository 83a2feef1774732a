#include <abut/io/file/decompress.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include <zlib.h>
#include <zstd.h>

namespace abut::detail {
namespace {

constexpr std::size_t chunk_size = std::size_t{1} << 16;

Problem damaged_problem(const char* what) {
    return {ProblemCode::bad_format, std::string(what) + " data is damaged, or cut short"};
}
Problem too_large_problem(const char* what, std::size_t max_bytes) {
    return {ProblemCode::too_large,
            std::string(what) + " data holds more than " + std::to_string(max_bytes) + " bytes"};
}

}  // namespace

Result<std::vector<std::byte>> decompress_zlib(std::span<const std::byte> bytes, std::size_t max_bytes) {
    z_stream stream{};
    constexpr int any_header = 32;  // zlib's or gzip's
    if (inflateInit2(&stream, MAX_WBITS + any_header) != Z_OK)
        return Problem{ProblemCode::too_large, "no memory for zlib"};
    const std::unique_ptr<z_stream, decltype(&inflateEnd)> owner(&stream, &inflateEnd);
    std::vector<std::byte> result;
    std::array<std::byte, chunk_size> chunk;
    std::size_t consumed = 0;
    for (;;) {
        const std::size_t available = std::min<std::size_t>(bytes.size() - consumed, std::size_t{1} << 30);
        // zlib only reads the input; its C interface lacks const.
        stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data() + consumed));
        stream.avail_in = static_cast<uInt>(available);
        stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
        stream.avail_out = static_cast<uInt>(chunk.size());
        const int status = inflate(&stream, Z_NO_FLUSH);
        consumed += available - stream.avail_in;
        const std::size_t produced = chunk.size() - stream.avail_out;
        if (result.size() + produced > max_bytes) return too_large_problem("compressed", max_bytes);
        result.insert(result.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(produced));
        if (status == Z_STREAM_END) return result;
        if (status != Z_OK) return damaged_problem("compressed");
    }
}

Result<std::vector<std::byte>> decompress_zstd(std::span<const std::byte> bytes, std::size_t max_bytes) {
    const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(), &ZSTD_freeDStream);
    if (!stream) return Problem{ProblemCode::too_large, "no memory for zstd"};
    // A larger window demands more memory than any tile layer needs.
    ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, 27);
    std::vector<std::byte> result;
    std::array<std::byte, chunk_size> chunk;
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    for (;;) {
        ZSTD_outBuffer out{chunk.data(), chunk.size(), 0};
        const std::size_t left = ZSTD_decompressStream(stream.get(), &out, &in);
        if (ZSTD_isError(left) != 0) return damaged_problem("zstd");
        if (result.size() + out.pos > max_bytes) return too_large_problem("zstd", max_bytes);
        result.insert(result.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(out.pos));
        if (left == 0) return result;
        if (in.pos == in.size && out.pos < out.size) return damaged_problem("zstd");
    }
}

}  // namespace abut::detail
