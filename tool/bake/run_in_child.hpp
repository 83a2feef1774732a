#pragma once

// Runs a verb of the tool in a child process, so that a crash ends one job alone.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace abut::tool {

/// Runs the tool with these arguments and returns its exit code.
using RunTool = std::function<int(const std::vector<std::string>&)>;

struct ChildResult {
    int code = -1;         ///< the exit code; negative: the process died
    std::string out, err;  ///< what it printed; if it died, `err` says how
};

/// The child's working folder is `folder`, and it reads nothing from stdin. Requires that this process has only one
/// thread. `scratch` is a folder for what it prints.
ChildResult run_in_child(const RunTool& run, const std::vector<std::string>& arguments,
                         const std::filesystem::path& folder, const std::filesystem::path& scratch);

}  // namespace abut::tool
