#pragma once

// Text reports of `abut check`, for people.

#include "tool/check/finding.hpp"
#include <abut/math/result.hpp>

#include <string>
#include <vector>

namespace abut::tool {

/// A file that was checked, or why it can't be. The message of a Problem begins with the file.
struct CheckedFile {
    std::string file;
    Result<FileReport> report;
};

/// The verdict in one line without a newline: "FAULTS FOUND: 1 pair collides; warnings: 2 leaks".
std::string verdict_line(const FileReport& report);

/// The verdict, the findings, notes and counts.
std::string text_of(const FileReport& report);

/// "12 files: 3 with errors, 1 with warnings, 8 clean"
std::string summary_of(const std::vector<CheckedFile>& files);

}  // namespace abut::tool
