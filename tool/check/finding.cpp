#include "tool/check/finding.hpp"

#include <algorithm>
#include <tuple>

namespace abut::tool {
const char* verdict(const FileReport& report) {
    if (report.count(Severity::error) > 0) return "errors";
    return report.findings.empty() ? "clean" : "warnings";
}

std::string subject(const Finding& finding, const char* between) {
    const std::string& first = finding.objects.front().path;
    switch (info(finding.rule).kind) {
        case Kind::gap:
            if (finding.objects.size() == 1) return "within " + first;
            [[fallthrough]];
        case Kind::contact:
            if (finding.rule == Rule::pile) return first + " and others";
            [[fallthrough]];
        case Kind::inside:
            return first + between + finding.objects.back().path;
        default:
            return first;
    }
}

std::string sentence(const Finding& finding) {
    return subject(finding) + ": " + finding.text;
}

void sort_findings(std::vector<Finding>& findings) {
    const auto rank = [](const Finding& finding) {
        return std::tuple(finding.severity == Severity::error ? 0 : 1, info(finding.rule).kind, -finding.badness);
    };
    std::stable_sort(findings.begin(), findings.end(),
                     [&](const Finding& a, const Finding& b) { return rank(a) < rank(b); });
}

}  // namespace abut::tool
