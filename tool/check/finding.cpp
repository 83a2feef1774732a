#include "tool/check/finding.hpp"

#include <algorithm>
#include <tuple>

namespace abut::tool {
namespace {

// Objects that a line names; the others are counted.
constexpr std::size_t max_named = 5;

}  // namespace

const char* verdict(const FileReport& report) {
    if (report.count(Severity::error) > 0) return "errors";
    return report.findings.empty() ? "clean" : "warnings";
}

std::string joined_paths(const Finding& finding, const char* between) {
    std::string text;
    const std::size_t named = std::min(finding.objects.size(), max_named);
    for (std::size_t i = 0; i < named; ++i) text += (i == 0 ? "" : between) + finding.objects[i].path;
    if (named < finding.objects.size()) text += between + std::to_string(finding.objects.size() - named) + " more";
    return text;
}

std::string sentence(const Finding& finding) {
    return joined_paths(finding, " and ") + ": " + finding.text;
}

void sort_findings(std::vector<Finding>& findings) {
    const auto rank = [](const Finding& finding) {
        return std::tuple(finding.severity == Severity::error ? 0 : 1, info(finding.rule).kind, -finding.badness);
    };
    std::stable_sort(findings.begin(), findings.end(),
                     [&](const Finding& a, const Finding& b) { return rank(a) < rank(b); });
}

}  // namespace abut::tool
