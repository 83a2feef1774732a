#pragma once

// JSON reports of `abut check`, and reading them as a baseline.

#include "tool/check/report.hpp"
#include "tool/shared/format.hpp"
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace abut::tool {

/// One JSON object; numbers unrounded.
template <int D>
std::string json_report(const Report<D>& report);

/// A finding of a baseline.
struct KnownFinding {
    std::string a, b;
    std::size_t first = 0, last = 0;
    double distance = 0;
};

/// A baseline: its contacts, and the entire report to look up other findings.
struct Baseline {
    std::vector<KnownFinding> contacts;
    std::uint64_t left_out = 0;  ///< contacts that it left out
    Json report = Json::object();
};

/// Reads a file that `abut check --json` wrote. The message of a Problem doesn't name the file.
Result<Baseline> read_baseline(const std::filesystem::path& file);

}  // namespace abut::tool
