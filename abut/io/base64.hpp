#pragma once

// Bytes written as text.

#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// The bytes of base64 text (RFC 4648, with either alphabet, padded or not). A Problem with the place of the first
/// character that is none of it.
Result<std::vector<std::byte>> decode_base64(std::string_view text);

/// Base64 text of the bytes, with '+' and '/', padded.
std::string encode_base64(std::span<const std::byte> bytes);

}  // namespace abut
