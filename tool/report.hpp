#pragma once

// What `abut check` has to say.

#include "check.hpp"
#include "faults.hpp"
#include "left_out.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace abut::tool {

struct Seconds {
    double read = 0;
    double build = 0;
    double check = 0;
    double level = 0;  ///< spawns, gaps, duplicates and leaks
};

/// Everything a report is made of.
template <int D>
struct Report {
    const Objects<D>& objects;
    const std::vector<double>& times;
    CheckResult<D> result;
    std::vector<std::string> notes;
    std::vector<LeftOutOf> left_out;
    Seconds seconds;
    bool has_baseline = false;
    std::size_t known = 0;  ///< findings left out because the baseline has them
    LevelView<D> level;     ///< at the first moment
    LevelFaults<D> faults;  ///< of that
};

/// For a person: the contacts, worst first, what else is at fault, what was looked at, and a verdict in the last line.
template <int D>
std::string text_report(const Report<D>& report, const std::string& scene_name);

/// How much of the way from its frame to the next has passed as a pair meets between the two.
template <int D>
double fraction(const Report<D>& report, const Finding<D>& finding) {
    const double from = report.times[finding.first], to = report.times[finding.first + 1];
    return (finding.time - from) / (to - from);
}

/// What objects are called that aren't convex solids.
template <int D>
inline constexpr const char* not_solids = D == 2 ? "composites" : "meshes";

}  // namespace abut::tool
