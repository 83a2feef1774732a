#pragma once

// A whole file in memory.

#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace abut {

/// All bytes of a regular file. A Problem where there is none, where it is a directory or something stranger, or where
/// it can't be read; its message doesn't name the file.
Result<std::vector<std::byte>> file_bytes(const std::filesystem::path& file);

}  // namespace abut
