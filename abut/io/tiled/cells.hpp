#pragma once

// Parsers for the cell data of Tiled layers.

#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace abut::tiled {

/// Parses comma-separated numbers. Returns a Problem unless there are exactly `count`.
Result<std::vector<std::uint32_t>> cells_from_csv(std::string_view text, std::size_t count);

/// Decodes base64 of little-endian 32-bit numbers, with compression "", "gzip", "zlib" or "zstd". Never allocates more
/// than `count` numbers take.
Result<std::vector<std::uint32_t>> cells_from_base64(std::string_view text, std::string_view compression,
                                                     std::size_t count);

}  // namespace abut::tiled
