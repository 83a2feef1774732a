#include "tool/check/report_json.hpp"

#include "tool/shared/version.hpp"

#include <utility>

namespace abut::tool {

const char* array_of(Rule rule) {
    if (rule == Rule::pile) return "piles";
    switch (info(rule).kind) {
        case Kind::spawn:
            return "spawns";
        case Kind::gap:
            return "gaps";
        case Kind::duplicate:
            return "duplicates";
        case Kind::leak:
            return "leaks";
        case Kind::floating:
            return "floating";
        default:
            return "contacts";
    }
}

Json json_of(const FileReport& report) {
    Json json = {{"file", report.file},
                 {"version", version()},
                 {"verdict", verdict(report)},
                 {"counts", {{"errors", report.count(Severity::error)}, {"warnings", report.count(Severity::warning)}}},
                 {"units", report.units}};
    for (const char* array : finding_arrays) json[array] = Json::array();
    for (const Finding& finding : report.findings) {
        Json entry = finding.data;
        entry["code"] = info(finding.rule).code;
        entry["severity"] = name_of(finding.severity);
        json[array_of(finding.rule)].push_back(std::move(entry));
    }
    json.update(report.details);
    json["warnings"] = report.notes;
    json["ignored"] = report.ignored;
    if (report.has_baseline) {
        json["known"] = report.known;
        json["mended"] = report.mended;
        json["stale"] = report.stale;
    }
    return json;
}

}  // namespace abut::tool
