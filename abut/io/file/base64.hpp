#pragma once

// Base64 text, RFC 4648.

#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abut::detail {

/// Decodes base64 text in the standard or the URL alphabet, padded or not. Returns a Problem (`bad_format`) with the
/// index of the first invalid character.
Result<std::vector<std::byte>> decode_base64(std::string_view text);

/// Encodes bytes in the standard alphabet ('+', '/'), padded with '='.
std::string encode_base64(std::span<const std::byte> bytes);

}  // namespace abut::detail
