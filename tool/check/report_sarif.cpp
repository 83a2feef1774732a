#include "tool/check/report_files.hpp"
#include "tool/shared/version.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

// A path as a URI reference, with `%` for all other bytes.
std::string uri_of(const std::string& file) {
    const std::filesystem::path path(file);
    std::string uri = path.is_absolute() ? "file://" : "";
    for (const char c : path.generic_string()) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_plain = (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
                              (byte >= '0' && byte <= '9') || std::string_view("-._~/").find(c) != std::string::npos;
        uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    return uri;
}

Json sarif_rules() {
    Json rules = Json::array();
    for (const RuleInfo& rule : all_rules()) {
        const char* level = rule.severity == Severity::off ? "none" : name_of(rule.severity);
        rules.push_back({{"id", rule.code},
                         {"name", rule.name},
                         {"shortDescription", {{"text", std::string(rule.text) + "."}}},
                         {"defaultConfiguration", {{"enabled", rule.severity != Severity::off}, {"level", level}}},
                         {"properties", {{"kind", name_of(rule.kind)}}}});
    }
    return rules;
}

Json result_of(const Finding& finding, const std::string& file) {
    Json objects = Json::array();
    for (const ObjectName& object : finding.objects)
        objects.push_back({{"name", object.name}, {"fullyQualifiedName", object.path}, {"kind", "object"}});
    const Json location = {{"physicalLocation", {{"artifactLocation", {{"uri", uri_of(file)}}}}},
                           {"logicalLocations", std::move(objects)}};
    return {{"ruleId", info(finding.rule).code},    {"ruleIndex", static_cast<std::size_t>(finding.rule)},
            {"level", name_of(finding.severity)},   {"message", {{"text", sentence(finding)}}},
            {"locations", Json::array({location})}, {"properties", finding.data}};
}

}  // namespace

std::string sarif_of(const std::vector<CheckedFile>& files) {
    Json results = Json::array(), notifications = Json::array();
    bool all_read = true;
    for (const CheckedFile& file : files) {
        if (!file.report) {
            all_read = false;
            notifications.push_back({{"level", "error"}, {"message", {{"text", file.report.problem().message}}}});
            continue;
        }
        for (const Finding& finding : file.report->findings) results.push_back(result_of(finding, file.file));
        for (const std::string& note : file.report->notes)
            notifications.push_back({{"level", "note"}, {"message", {{"text", file.file + ": " + note}}}});
    }
    const Json driver = {{"name", "abut"}, {"version", version()}, {"rules", sarif_rules()}};
    const Json run = {
        {"tool", {{"driver", driver}}},
        {"invocations",
         Json::array({{{"executionSuccessful", all_read}, {"toolExecutionNotifications", std::move(notifications)}}})},
        {"results", std::move(results)}};
    return to_text({{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                    {"version", "2.1.0"},
                    {"runs", Json::array({run})}});
}

}  // namespace abut::tool
