#pragma once

// Patterns for names: * stands for anything, ? for one character; both stand for '/' as well.

#include <string_view>

namespace abut {

/// Whether the pattern describes the whole name.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace abut
