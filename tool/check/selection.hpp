#pragma once

// Leaves out findings that options name.

#include "tool/check/finding.hpp"
#include "tool/check/settings.hpp"

#include <vector>

namespace abut::tool {

/// True if the pattern's code fits, and its object patterns match two of the finding's objects, or the only one. With
/// one pattern, any object.
bool is_ignored(const Finding& finding, const IgnorePattern& pattern);

/// Removes findings that a pattern matches, counts them, and notes patterns that match none.
void remove_ignored(FileReport& report, const std::vector<IgnorePattern>& patterns);

}  // namespace abut::tool
