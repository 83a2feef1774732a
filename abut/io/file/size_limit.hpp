#pragma once

// The limit of the size of a file that is read into memory.

#include <abut/math/result.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace abut::detail {

/// Returns a Problem (`too_large`) with both sizes if there are more bytes than the limit.
inline std::optional<Problem> check_size(std::uintmax_t bytes, std::uintmax_t max_bytes) {
    if (bytes <= max_bytes) return std::nullopt;
    return Problem{ProblemCode::too_large, "has " + std::to_string(bytes >> 20) + " MB; the limit is " +
                                               std::to_string(max_bytes >> 20) + " MB"};
}

}  // namespace abut::detail
