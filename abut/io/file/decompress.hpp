#pragma once

// Decompression with a limit on the output size.

#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut::detail {

/// Decompresses zlib (RFC 1950) or gzip (RFC 1952) data; the header decides which. Returns a Problem if the data is
/// damaged or truncated (`bad_format`), or decompresses to more than `max_bytes` (`too_large`).
Result<std::vector<std::byte>> decompress_zlib(std::span<const std::byte> bytes, std::size_t max_bytes);

/// Decompresses Zstandard data (RFC 8878). The Problems are those of `decompress_zlib`.
Result<std::vector<std::byte>> decompress_zstd(std::span<const std::byte> bytes, std::size_t max_bytes);

}  // namespace abut::detail
