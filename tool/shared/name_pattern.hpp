#pragma once

// Glob patterns for named items.

#include <abut/io/file/glob.hpp>

#include <string>
#include <string_view>

namespace abut::tool {

/// The text with ASCII letters in lower case.
inline std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

/// True if the pattern matches the item's path, its own name, or its class.
template <class Named>
bool matches_name(std::string_view pattern, const Named& named) {
    if (detail::glob_matches(pattern, named.path) || detail::glob_matches(pattern, named.name)) return true;
    return !named.type.empty() && detail::glob_matches(pattern, named.type);
}

}  // namespace abut::tool
