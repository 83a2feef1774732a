#pragma once

// Text in lines of a given width.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace abut::tool {

/// Breaks a text at blanks, each line after the first behind `indent` blanks. The first line begins at `column`. A
/// word that is longer than a line stays whole.
inline std::string wrapped(std::string_view text, std::size_t width, std::size_t indent, std::size_t column) {
    std::string result;
    bool is_first = true;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string_view word = text.substr(at, end - at);
        at = end + 1;
        if (word.empty()) continue;
        if (!is_first && column + 1 + word.size() > width) {
            result += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (!is_first) {
            result += ' ';
            ++column;
        }
        result += word;
        column += word.size();
        is_first = false;
    }
    return result + "\n";
}

}  // namespace abut::tool
