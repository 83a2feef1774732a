#pragma once

// An earlier JSON report: what it has is left out of a later report, and what it has and is gone is named.

#include "tool/check/finding.hpp"
#include "tool/check/severities.hpp"
#include "tool/shared/format.hpp"
#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace abut::tool {

struct Baseline {
    Json report = Json::object();  ///< of one file
    std::size_t contacts = 0;      ///< count of contacts that it has
    std::uint64_t left_out = 0;    ///< count of contacts that it left out
};

/// Reads a file that `abut check --json` wrote. Of a report of several files, the one for `scene` is taken; none is
/// there for a file that is new. The message of a Problem doesn't name the file.
Result<Baseline> read_baseline(const std::filesystem::path& file, const std::string& scene);

/// Removes known findings and counts them, and names what the baseline has and the report has not: `mended` if the
/// objects are still there, else `stale`. A contact is known if the pair touched at one of the same frames, and is no
/// deeper than before by more than the allowed depth. Other findings are known at the same place of the same objects,
/// to within a gap's width or a leak's extent; depths and widths are not compared. `checks` tells the rules that were
/// checked, `has_object` the names that the file has.
void compare(FileReport& report, const Baseline& baseline, const std::function<bool(const RuleInfo&)>& checks,
             const std::function<bool(const std::string&)>& has_object);

}  // namespace abut::tool
