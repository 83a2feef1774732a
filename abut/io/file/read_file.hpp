#pragma once

// Reads an entire file into memory.

#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace abut::detail {

/// Returns all bytes of a regular file. Returns a Problem if the file doesn't exist (`not_found`), is not a regular
/// file or can't be read (both `unreadable`). The message doesn't name the file.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& file);

}  // namespace abut::detail
