#pragma once

// Parses JSON without exceptions: the sources of this folder are built where there are none, too.

#include <abut/math/result.hpp>

#include <string_view>

#include <nlohmann/json.hpp>

namespace abut::detail {

/// Returns a Problem (`bad_format`) with the position of the first error.
Result<nlohmann::json> parse_json(std::string_view text);

}  // namespace abut::detail
