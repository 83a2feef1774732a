#include "tool/check/report_text.hpp"

#include "tool/shared/color.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

// Limit of lines for one subject; --json lists all.
constexpr std::size_t max_listed_lines = 5;

// Counts in the verdict: of pairs, or of findings.
struct Phrase {
    std::vector<Rule> rules;
    const char *one, *many;
    bool of_pairs = false;
};

const std::vector<Phrase>& phrases() {
    static const std::vector<Phrase> all{
        {{Rule::spawn_blocked, Rule::spawn_beneath, Rule::spawn_no_ground},
         "spawn is blocked or out of place",
         "spawns are blocked or out of place"},
        {{Rule::inside}, "object is inside another", "objects are inside others", true},
        {{Rule::overlap, Rule::between_frames}, "pair collides", "pairs collide", true},
        {{Rule::pile}, "pile of objects in one place", "piles of objects in one place"},
        {{Rule::too_near}, "pair comes too near", "pairs come too near", true},
        {{Rule::narrow_passage, Rule::narrow_detour}, "passage is too narrow", "passages are too narrow"},
        {{Rule::same_object}, "object is duplicated", "objects are duplicated"},
        {{Rule::same_facets}, "object has parts twice", "objects have parts twice"},
        {{Rule::hole, Rule::crack, Rule::non_manifold, Rule::flipped}, "leak", "leaks"},
        {{Rule::floating}, "object rests on nothing", "objects rest on nothing"},
    };
    return all;
}

std::string counts_of(const FileReport& report, Severity severity) {
    std::vector<std::string> parts;
    for (const Phrase& phrase : phrases()) {
        std::set<std::string> pairs;
        std::size_t count = 0;
        for (const Finding& finding : report.findings) {
            if (finding.severity != severity ||
                std::find(phrase.rules.begin(), phrase.rules.end(), finding.rule) == phrase.rules.end())
                continue;
            ++count;
            if (phrase.of_pairs) pairs.insert(subject(finding, "\n"));
        }
        if (count > 0) parts.push_back(counted(phrase.of_pairs ? pairs.size() : count, phrase.one, phrase.many));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

const char* heading(Kind kind) {
    switch (kind) {
        case Kind::spawn:
            return "spawns";
        case Kind::inside:
            return "objects inside others";
        case Kind::contact:
            return "contacts";
        case Kind::gap:
            return "gaps";
        case Kind::duplicate:
            return "duplicates";
        case Kind::leak:
            return "leaks";
        case Kind::floating:
            break;
    }
    return "floating objects";
}

using Group = std::vector<const Finding*>;

// By subject, in the order of the first finding of each.
std::vector<Group> by_subject(const Group& section) {
    std::vector<Group> groups;
    std::unordered_map<std::string, std::size_t> numbers;
    for (const Finding* finding : section) {
        const auto [entry, is_new] = numbers.try_emplace(subject(*finding, "\n"), groups.size());
        if (is_new) groups.emplace_back();
        groups[entry->second].push_back(finding);
    }
    return groups;
}

// Findings of one kind and severity.
std::string text_of(const Group& section) {
    std::set<std::string_view> codes;
    for (const Finding* finding : section) codes.insert(info(finding->rule).code);
    std::string text =
        colored(Tone::heading,
                fmt::format("{}{} ({})", section.front()->severity == Severity::warning ? "warnings: " : "",
                            heading(info(section.front()->rule).kind), fmt::join(codes, ", "))) +
        "\n";
    const std::vector<Group> groups = by_subject(section);
    for (std::size_t i = 0; i < groups.size() && i < max_listed; ++i) {
        text += fmt::format("{:4}. {}\n", i + 1, subject(*groups[i].front(), "  and  "));
        for (std::size_t k = 0; k < groups[i].size() && k < max_listed_lines; ++k)
            text += "        " + groups[i][k]->text + "\n";
        if (groups[i].size() > max_listed_lines)
            text += fmt::format("        and {} more\n", groups[i].size() - max_listed_lines);
    }
    if (groups.size() > max_listed)
        text += fmt::format("      and {} more (--json lists them all)\n", groups.size() - max_listed);
    return text + "\n";
}

std::string list_of(const char* what, const std::vector<std::string>& lines) {
    if (lines.empty()) return {};
    std::string text = std::string(what) + "\n";
    for (std::size_t i = 0; i < lines.size() && i < max_listed; ++i) text += "      " + lines[i] + "\n";
    if (lines.size() > max_listed)
        text += fmt::format("      and {} more (--json lists them all)\n", lines.size() - max_listed);
    return text + "\n";
}

}  // namespace

std::string verdict_line(const FileReport& report) {
    const std::string errors = counts_of(report, Severity::error), warnings = counts_of(report, Severity::warning);
    const char* suffix = report.has_baseline ? " that didn't before" : "";
    if (!errors.empty())
        return fmt::format("FAULTS FOUND: {}{}{}{}", errors, suffix, warnings.empty() ? "" : "; warnings: ", warnings);
    if (!warnings.empty()) return fmt::format("NO ERRORS, BUT WARNINGS: {}{}", warnings, suffix);
    return fmt::format("CLEAN: no pair collides{}", suffix);
}

std::string text_of(const FileReport& report) {
    const Tone tone = report.count(Severity::error) > 0 ? Tone::error
                      : report.findings.empty()         ? Tone::fine
                                                        : Tone::warning;
    std::string text = report.file + "\n" + colored(tone, verdict_line(report)) + "\n\n";
    const std::vector<Finding>& all = report.findings;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
        Group section;
        const auto is_same = [&](const Finding& finding) {
            return finding.severity == all[begin].severity && info(finding.rule).kind == info(all[begin].rule).kind;
        };
        for (; end < all.size() && is_same(all[end]); ++end) section.push_back(&all[end]);
        text += text_of(section);
    }
    text += list_of("mended since the baseline", report.mended);
    text += list_of("in the baseline, of objects that are gone", report.stale);
    for (const std::string& note : report.notes) text += "note: " + note + "\n";
    if (!report.notes.empty()) text += "\n";
    return text + report.summary;
}

std::string summary_of(const std::vector<CheckedFile>& files) {
    std::size_t errors = 0, warnings = 0, clean = 0, unreadable = 0;
    for (const CheckedFile& file : files) {
        if (!file.report)
            ++unreadable;
        else if (file.report->count(Severity::error) > 0)
            ++errors;
        else
            ++(file.report->findings.empty() ? clean : warnings);
    }
    std::string text = counted(files.size(), "file: ", "files: ");
    text += fmt::format("{} with errors, {} with warnings, {} clean", errors, warnings, clean);
    if (unreadable > 0) text += fmt::format(", {} unreadable", unreadable);
    return text;
}

}  // namespace abut::tool
