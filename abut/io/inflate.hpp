#pragma once

// Compressed bytes made whole again, up to a limit.

#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

/// What zlib or gzip made small, by whichever it was (RFC 1950, RFC 1952). A Problem where that is damaged, or more
/// than `most` bytes.
Result<std::vector<std::byte>> inflated(std::span<const std::byte> bytes, std::size_t most);

/// What Zstandard made small (RFC 8878).
Result<std::vector<std::byte>> inflated_zstd(std::span<const std::byte> bytes, std::size_t most);

}  // namespace abut
