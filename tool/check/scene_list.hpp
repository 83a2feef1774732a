#pragma once

// The files that a command line names.

#include <abut/math/result.hpp>

#include <string>
#include <vector>

namespace abut::tool {

/// Files as they are; of a folder, all scenes and levels in it and below it, sorted by path; "-" is a list on stdin
/// with one file or folder on each line. Returns a Problem if a folder has none or can't be read.
Result<std::vector<std::string>> scenes_of(const std::vector<std::string>& arguments);

}  // namespace abut::tool
