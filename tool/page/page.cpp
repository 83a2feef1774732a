#include "tool/page/page.hpp"

#include "tool/check/report_text.hpp"
#include "tool/page/report_template.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

const char* text_of(Kind kind) {
    switch (kind) {
        case Kind::spawn:
            return "places where the character starts and can't stand";
        case Kind::inside:
            return "objects inside of others";
        case Kind::contact:
            return "pairs of objects that overlap, or come too near";
        case Kind::gap:
            return "passages too narrow for the character";
        case Kind::duplicate:
            return "objects, or parts of a mesh, that are there twice";
        case Kind::leak:
            return "holes, cracks and wrong triangles of meshes";
        case Kind::floating:
            break;
    }
    return "objects that rest on nothing";
}

// The same for the same objects in every run: the code, and a hash of the paths (FNV-1a).
std::string id_of(const Finding& finding, std::map<std::string, int>& used) {
    std::uint32_t hash = 2166136261u;
    for (const ObjectName& object : finding.objects)
        for (const char c : object.path + "\n") hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
    const std::string id = fmt::format("{}-{:08x}", info(finding.rule).code, hash);
    const int count = ++used[id];
    return count == 1 ? id : fmt::format("{}-{}", id, count);
}

Json finding_json(const Finding& finding, const std::string& id,
                  const std::vector<std::vector<std::uint32_t>>& parties) {
    const RuleInfo& rule = info(finding.rule);
    Json result = {{"id", id},
                   {"code", rule.code},
                   {"kind", name_of(rule.kind)},
                   {"severity", name_of(finding.severity)},
                   {"title", subject(finding)},
                   {"text", finding.text},
                   {"parties", parties},
                   {"position", finding.position}};
    const Json& data = finding.data;
    result["points"] = data.contains("points") ? data["points"] : Json::array();
    if (data.contains("normal")) result["normal"] = data["normal"];
    if (data.contains("distance")) result["depth"] = std::abs(data["distance"].get<double>());
    for (const char* key : {"depth", "width"})
        if (data.contains(key)) result["depth"] = data[key];
    if (data.contains("time") && data.contains("last_time"))
        result["time"] = {data["time"], data["last_time"], finding.time};
    return result;
}

// Lines of a label, blanks and a text, as FileReport has them.
Json summary_json(const std::string& summary) {
    Json result = Json::array();
    std::istringstream lines(summary);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t blanks = line.find("  ");
        const std::size_t text = line.find_first_not_of(' ', std::min(blanks, line.size()));
        if (text != std::string::npos) result.push_back({line.substr(0, blanks), line.substr(text)});
    }
    return result;
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return result;
}

// Inside of a script element no text may look like its end; JSON has '<' in strings alone.
std::string embedded(const Json& json) {
    std::string result;
    for (const char c : to_text(json)) result += c == '<' ? "\\u003c" : std::string(1, c);
    return result;
}

}  // namespace

template <int D>
Json page_json(const FileReport& report, PageScene<D>& scene, const Vec3& up, std::string_view version) {
    const std::size_t shown = std::min(report.findings.size(), max_page_findings);
    std::vector<std::vector<std::vector<std::uint32_t>>> parties;
    Json scene_data = scene_json(scene, std::span(report.findings).first(shown), parties);
    Json findings = Json::array(), kinds = Json::object();
    std::map<std::string, int> used;
    for (std::size_t i = 0; i < shown; ++i) {
        const Finding& finding = report.findings[i];
        const Kind kind = info(finding.rule).kind;
        kinds[name_of(kind)] = text_of(kind);
        findings.push_back(finding_json(finding, id_of(finding, used), parties[i]));
    }
    Json result = {{"version", version},
                   {"file", report.file},
                   {"dimension", D},
                   {"clean", report.findings.empty()},
                   {"verdict", verdict_line(report)},
                   {"summary", summary_json(report.summary)},
                   {"notes", report.notes},
                   {"kinds", std::move(kinds)},
                   {"left_out", report.findings.size() - shown},
                   {"findings", std::move(findings)},
                   {"up", numbers(up)}};
    result.update(scene_data);
    return result;
}
template Json page_json(const FileReport&, PageScene<2>&, const Vec3&, std::string_view);
template Json page_json(const FileReport&, PageScene<3>&, const Vec3&, std::string_view);

std::string page(const Json& data) {
    std::string result(report_template);
    const auto put = [&](std::string_view place, const std::string& text) {
        const std::size_t at = result.find(place);
        if (at != std::string::npos) result.replace(at, place.size(), text);
    };
    // The data first: a title could contain the name of their place.
    put("@REPORT@", embedded(data));
    put("@TITLE@", escaped(data.value("verdict", "") + ": " + data.value("file", "")));
    return result;
}

}  // namespace abut::tool
