#include "tool/check/selection.hpp"

#include "tool/shared/name_pattern.hpp"

#include <cstddef>

#include <fmt/format.h>

namespace abut::tool {

bool is_ignored(const Finding& finding, const IgnorePattern& pattern) {
    if (!pattern.code.empty() && !names_rule(pattern.code, info(finding.rule))) return false;
    const std::vector<ObjectName>& objects = finding.objects;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        if (!matches_name(pattern.a, objects[i])) continue;
        if (pattern.b.empty()) return true;
        for (std::size_t j = 0; j < objects.size(); ++j)
            if ((i != j || objects.size() == 1) && matches_name(pattern.b, objects[j])) return true;
    }
    return false;
}

void remove_ignored(FileReport& report, const std::vector<IgnorePattern>& patterns) {
    std::vector<bool> used(patterns.size());
    report.ignored += std::erase_if(report.findings, [&](const Finding& finding) {
        bool ignored = false;
        for (std::size_t i = 0; i < patterns.size(); ++i) {
            if (!is_ignored(finding, patterns[i])) continue;
            ignored = true;
            used[i] = true;
        }
        return ignored;
    });
    for (std::size_t i = 0; i < patterns.size(); ++i)
        if (!used[i])
            report.notes.push_back(fmt::format("{}: '{}' matches no finding", patterns[i].where, patterns[i].text));
}

}  // namespace abut::tool
