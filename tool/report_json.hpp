#pragma once

// The report as JSON, and what is to be known of an earlier one.

#include "report.hpp"
#include "written.hpp"
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace abut::tool {

/// One object; numbers unrounded.
template <int D>
std::string json_report(const Report<D>& report);

/// A finding of an earlier report.
struct KnownFinding {
    std::string a, b;
    std::size_t first = 0, last = 0;
    double distance = 0;
};

/// An earlier report: its contacts, and all of it, where what else it found is looked up.
struct Baseline {
    std::vector<KnownFinding> contacts;
    std::uint64_t left_out = 0;  ///< contacts that it had no room for
    Json report = Json::object();
};

/// The findings of a file that `abut check --json` wrote. The message of a Problem doesn't name the file.
Result<Baseline> read_baseline(const std::filesystem::path& file);

}  // namespace abut::tool
