#include "tool/check/baseline.hpp"

#include "tool/check/report_json.hpp"
#include <abut/io/file/read_file.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace abut::tool {
namespace {

bool is_contact(const Json& entry) {
    if (!entry.is_object()) return false;
    for (const char* key : {"a", "b", "frame", "last_frame", "distance"})
        if (!entry.contains(key)) return false;
    return entry["a"].is_string() && entry["b"].is_string() && entry["distance"].is_number() &&
           entry["frame"].is_number_unsigned() && entry["last_frame"].is_number_unsigned();
}

// All members that identify a finding, except for its position and sizes.
std::string names_in(const Json& entry, const char* array) {
    std::string names = array;
    for (const char* key : {"name", "fault", "a", "b", "object", "objects", "kind", "pieces"})
        if (entry.contains(key)) names += "\n" + entry[key].dump(-1, ' ', false, Json::error_handler_t::replace);
    return names;
}

std::optional<double> distance(const Json& a, const Json& b) {
    if (!a.is_array() || !b.is_array() || a.size() != b.size()) return std::nullopt;
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!a[i].is_number() || !b[i].is_number()) return std::nullopt;
        const double difference = a[i].get<double>() - b[i].get<double>();
        sum += difference * difference;
    }
    return std::sqrt(sum);
}

bool is_at_same_frames(const Json& now, const Json& old) {
    return old["frame"].get<std::size_t>() <= now["last_frame"].get<std::size_t>() &&
           now["frame"].get<std::size_t>() <= old["last_frame"].get<std::size_t>();
}

bool is_deeper(const Json& now, const Json& old) {
    return now["distance"].get<double>() < old["distance"].get<double>() - now["allowed"].get<double>();
}

bool is_same_place(const Json& now, const Json& old) {
    double reach = std::numeric_limits<double>::infinity();
    for (const char* key : {"width", "extent"})
        if (now.contains(key)) reach = now[key].get<double>();
    if (!old.contains("position")) return false;
    const std::optional<double> offset = distance(now["position"], old["position"]);
    return offset && *offset <= reach;
}

// The paths that an entry names.
std::vector<std::string> paths_in(const Json& entry) {
    std::vector<std::string> paths;
    for (const char* key : {"name", "a", "b", "object"})
        if (entry.contains(key) && entry[key].is_string()) paths.push_back(entry[key]);
    if (entry.contains("objects") && entry["objects"].is_array())
        for (const Json& path : entry["objects"])
            if (path.is_string()) paths.push_back(path);
    return paths;
}

struct Known {
    const Json* entry;
    const char* array;
    bool found = false;
};

// The report of a scene in that of many files; nothing if it has none.
const Json* report_of(const Json& files, const std::string& scene) {
    for (const Json& report : files)
        if (report.is_object() && report.contains("file") && report["file"] == scene) return &report;
    return nullptr;
}

}  // namespace

Result<Baseline> read_baseline(const std::filesystem::path& file, const std::string& scene) {
    const Result<std::vector<std::byte>> bytes = detail::read_file(file);
    if (!bytes) return bytes.problem();
    const auto* text = reinterpret_cast<const char*>(bytes->data());
    Json json = Json::parse(text, text + bytes->size(), nullptr, false);
    const Problem invalid{ProblemCode::bad_format, "is no report of `abut check --json`"};
    if (json.is_object() && json.contains("files") && json["files"].is_array()) {
        const Json* found = report_of(json["files"], scene);
        if (found == nullptr || !found->contains("contacts")) return Baseline{};
        json = Json(*found);
    }
    if (!json.is_object() || !json.contains("contacts") || !json["contacts"].is_array()) return invalid;
    for (std::size_t i = 0; i < json["contacts"].size(); ++i)
        if (!is_contact(json["contacts"][i]))
            return Problem{ProblemCode::bad_format, invalid.message + ": contacts[" + std::to_string(i) + "]"};
    Baseline result;
    result.contacts = json["contacts"].size();
    if (const auto left_out = json.find("contacts_left_out"); left_out != json.end() && left_out->is_number_unsigned())
        result.left_out = *left_out;
    result.report = std::move(json);
    return result;
}

void compare(FileReport& report, const Baseline& baseline, const std::function<bool(const RuleInfo&)>& checks,
             const std::function<bool(const std::string&)>& has_object) {
    report.has_baseline = true;
    std::vector<Known> all;
    for (const char* array : finding_arrays)
        if (baseline.report.contains(array) && baseline.report[array].is_array())
            for (const Json& entry : baseline.report[array])
                if (entry.is_object()) all.push_back({&entry, array});
    std::map<std::string, std::vector<Known*>> by_names;
    for (Known& known : all) by_names[names_in(*known.entry, known.array)].push_back(&known);
    report.known += std::erase_if(report.findings, [&](const Finding& finding) {
        const char* array = array_of(finding.rule);
        const auto olds = by_names.find(names_in(finding.data, array));
        if (olds == by_names.end()) return false;
        bool is_known = false;
        for (Known* old : olds->second) {
            const bool is_pair = is_contact(finding.data);
            if (is_pair ? !is_at_same_frames(finding.data, *old->entry) : !is_same_place(finding.data, *old->entry))
                continue;
            old->found = true;
            is_known = is_known || !is_pair || !is_deeper(finding.data, *old->entry);
        }
        return is_known;
    });
    for (const Known& known : all) {
        const auto& rules = all_rules();
        const bool is_checked = std::any_of(rules.begin(), rules.end(), [&](const RuleInfo& rule) {
            return std::string_view(array_of(rule.rule)) == known.array && checks(rule);
        });
        if (known.found || !is_checked) continue;
        const std::vector<std::string> paths = paths_in(*known.entry);
        std::string line = known.array;
        for (std::size_t i = 0; i < paths.size(); ++i) line += (i == 0 ? ": " : " and ") + paths[i];
        const bool are_there = std::all_of(paths.begin(), paths.end(), has_object);
        (are_there ? report.mended : report.stale).push_back(std::move(line));
    }
}

}  // namespace abut::tool
