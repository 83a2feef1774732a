#pragma once

// Glob patterns over names: `*` matches any sequence of characters and `?` any one character, '/' included.

#include <string_view>

namespace abut::detail {

/// True if the pattern matches the entire name. Takes O(pattern x name) time and no memory.
bool glob_matches(std::string_view pattern, std::string_view name);

}  // namespace abut::detail
