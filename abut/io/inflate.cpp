#include <abut/io/inflate.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include <zlib.h>
#include <zstd.h>

namespace abut {
namespace {

constexpr std::size_t step = std::size_t{1} << 16;

Problem damaged(const char* what) {
    return {ProblemCode::bad_format, std::string(what) + " data is damaged, or cut short"};
}
Problem too_much(const char* what, std::size_t most) {
    return {ProblemCode::too_large, std::string(what) + " data holds more than " + std::to_string(most) + " bytes"};
}

}  // namespace

Result<std::vector<std::byte>> inflated(std::span<const std::byte> bytes, std::size_t most) {
    z_stream stream{};
    constexpr int any_header = 32;  // zlib's or gzip's
    if (inflateInit2(&stream, MAX_WBITS + any_header) != Z_OK)
        return Problem{ProblemCode::too_large, "no memory for zlib"};
    const std::unique_ptr<z_stream, decltype(&inflateEnd)> owner(&stream, &inflateEnd);
    std::vector<std::byte> result;
    std::array<std::byte, step> piece;
    std::size_t taken = 0;
    for (;;) {
        const std::size_t now = std::min<std::size_t>(bytes.size() - taken, std::size_t{1} << 30);
        // zlib reads only; its interface is older than const.
        stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data() + taken));
        stream.avail_in = static_cast<uInt>(now);
        stream.next_out = reinterpret_cast<Bytef*>(piece.data());
        stream.avail_out = static_cast<uInt>(piece.size());
        const int status = inflate(&stream, Z_NO_FLUSH);
        taken += now - stream.avail_in;
        const std::size_t got = piece.size() - stream.avail_out;
        if (result.size() + got > most) return too_much("compressed", most);
        result.insert(result.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(got));
        if (status == Z_STREAM_END) return result;
        if (status != Z_OK) return damaged("compressed");
    }
}

Result<std::vector<std::byte>> inflated_zstd(std::span<const std::byte> bytes, std::size_t most) {
    const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(), &ZSTD_freeDStream);
    if (!stream) return Problem{ProblemCode::too_large, "no memory for zstd"};
    // Beyond this a frame asks for more memory than its layer can be worth.
    ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, 27);
    std::vector<std::byte> result;
    std::array<std::byte, step> piece;
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    for (;;) {
        ZSTD_outBuffer out{piece.data(), piece.size(), 0};
        const std::size_t left = ZSTD_decompressStream(stream.get(), &out, &in);
        if (ZSTD_isError(left) != 0) return damaged("zstd");
        if (result.size() + out.pos > most) return too_much("zstd", most);
        result.insert(result.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(out.pos));
        if (left == 0) return result;
        if (in.pos == in.size && out.pos < out.size) return damaged("zstd");
    }
}

}  // namespace abut
