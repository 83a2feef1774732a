#pragma once

// Glob patterns for named items.

#include <abut/io/file/glob.hpp>

#include <string_view>

namespace abut::tool {

/// True if the pattern matches the item's path or its own name.
template <class Named>
bool matches_name(std::string_view pattern, const Named& named) {
    return detail::glob_matches(pattern, named.path) || detail::glob_matches(pattern, named.name);
}

}  // namespace abut::tool
