#pragma once

// Patterns for names: * stands for anything, ? for one character; both stand for '/' as well.

#include <string_view>

namespace abut::tool {

/// Whether the pattern describes the whole name.
bool matches(std::string_view pattern, std::string_view name);

/// Whether the pattern describes a thing: its path, or its own name alone.
template <class Thing>
bool describes(std::string_view pattern, const Thing& thing) {
    return matches(pattern, thing.path) || matches(pattern, thing.name);
}

}  // namespace abut::tool
