#pragma once

// Writes a file atomically: readers see the old content or the new content.

#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

namespace abut {

/// Writes all bytes to a temporary file in the same folder and then renames it to `file`. On failure the old file
/// stays.
/// A path that exists and is not a regular file, such as a pipe, is written to directly. Returns a Problem
/// (`unreadable`) if the folder doesn't exist or the file can't be written. The message doesn't name the file.
std::optional<Problem> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
std::optional<Problem> write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace abut
