#pragma once

// The tiles of a Tiled layer as files hold them.

#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace abut::tiled {

/// Numbers with commas between them. `count` of them, or a Problem.
Result<std::vector<std::uint32_t>> cells_from_csv(std::string_view text, std::size_t count);

/// Base64 of little-endian numbers, plain or compressed: "", "gzip", "zlib" or "zstd". Never makes more of it than
/// `count` of them.
Result<std::vector<std::uint32_t>> cells_from_base64(std::string_view text, std::string_view compression,
                                                     std::size_t count);

}  // namespace abut::tiled
