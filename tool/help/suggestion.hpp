#pragma once

// What a misspelt word may mean.

#include <string>
#include <string_view>
#include <vector>

namespace abut::tool {

/// The nearest of the words, by the number of letters to insert, delete, replace or swap: at most a third of the
/// word's. Empty if none is that near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

/// "; did you mean 'check'?", or empty.
std::string suggestion(std::string_view word, const std::vector<std::string>& words);

}  // namespace abut::tool
