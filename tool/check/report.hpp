#pragma once

// The report of `abut check`.

#include "tool/check/check.hpp"
#include "tool/faults/faults.hpp"
#include "tool/shared/left_out.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace abut::tool {

struct Seconds {
    double read = 0;
    double build = 0;
    double check = 0;
    double level = 0;  ///< checks of spawns, gaps, duplicates and leaks
};

/// All contents of a report.
template <int D>
struct Report {
    const Objects<D>& objects;
    const std::vector<double>& times;
    CheckResult<D> result;
    std::vector<std::string> notes;
    std::vector<LeftOutOf> left_out;
    Seconds seconds;
    bool has_baseline = false;
    std::size_t known = 0;  ///< count of findings left out because the baseline has them
    LevelView<D> level;     ///< at the first time
    LevelFaults<D> faults;  ///< faults of the level
};

/// Text for people: contacts, deepest first, other faults, a summary, and a verdict in the last line.
template <int D>
std::string text_report(const Report<D>& report, const std::string& scene_name);

/// The time of a contact between frames, as a fraction from its frame to the next one.
template <int D>
double fraction(const Report<D>& report, const ContactFinding<D>& finding) {
    const double from = report.times[finding.first], to = report.times[finding.first + 1];
    return (finding.time - from) / (to - from);
}

/// The name of objects that aren't convex solids.
template <int D>
inline constexpr const char* not_solids = D == 2 ? "composites" : "meshes";

}  // namespace abut::tool
