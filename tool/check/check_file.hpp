#pragma once

// Checks one file: reads it, runs all checks of a plan, and collects the findings.

#include "tool/check/finding.hpp"
#include "tool/check/settings.hpp"
#include <abut/math/result.hpp>

#include <cstddef>
#include <string>

namespace abut::tool {

/// The message of a Problem begins with the file.
Result<FileReport> check_file(const std::string& file, const CheckPlan& plan, std::size_t threads);

}  // namespace abut::tool
