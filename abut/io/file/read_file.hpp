#pragma once

// Reads an entire file into memory.

#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <vector>

namespace abut::detail {

/// Returns all bytes of a regular file. Returns a Problem if the file doesn't exist (`not_found`), is not a regular
/// file or can't be read (both `unreadable`), or has more bytes than the limit (`too_large`). The message doesn't name
/// the file.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& file,
                                         std::uintmax_t max_bytes = std::numeric_limits<std::uintmax_t>::max());

}  // namespace abut::detail
