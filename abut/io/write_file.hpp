#pragma once

// A whole file, or none.

#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

namespace abut {

/// Writes all bytes under another name in the same folder, and only then takes the place of the file, so that nobody
/// ever sees half of it; what was there stays where that fails. What isn't a regular file, such as a pipe, is just
/// written to. A Problem (`unreadable`) where the folder isn't there, or the file can't be written; its message doesn't
/// name the file.
std::optional<Problem> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
std::optional<Problem> write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace abut
