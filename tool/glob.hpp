#pragma once

// Patterns for things that have names.

#include <abut/io/glob.hpp>

#include <string_view>

namespace abut::tool {

/// Whether the pattern describes a thing: its path, or its own name alone.
template <class Thing>
bool describes(std::string_view pattern, const Thing& thing) {
    return matches(pattern, thing.path) || matches(pattern, thing.name);
}

}  // namespace abut::tool
