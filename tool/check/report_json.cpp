#include "tool/check/report_json.hpp"

#include "tool/faults/faults_report.hpp"
#include "tool/shared/format.hpp"
#include <abut/io/file/read_file.hpp>

namespace abut::tool {
namespace {

template <int D>
Json contact(const Report<D>& report, const ContactFinding<D>& finding) {
    Json points = Json::array();
    for (const Vec<D>& point : finding.points) points.push_back(numbers(point));
    Json result = {{"a", report.objects[finding.a].path},
                   {"b", report.objects[finding.b].path},
                   {"frame", finding.first},
                   {"last_frame", finding.last},
                   {"distance", finding.distance},
                   {"normal", numbers(finding.normal)},
                   {"points", std::move(points)},
                   {"deepest_frame", finding.deepest},
                   {"time", finding.between ? finding.time : report.times[finding.first]},
                   {"last_time", finding.between ? finding.last_time : report.times[finding.last]},
                   {"deepest_time", finding.between ? finding.deepest_time : report.times[finding.deepest]}};
    if (finding.between) {
        result["between"] = true;
        result["fraction"] = fraction(report, finding);
    }
    if (finding.inside) result["inside"] = true;
    return result;
}

// Reads a contact of a report; false if a required member is missing or has another type.
bool read_known(const Json& json, KnownFinding& known) {
    if (!json.is_object()) return false;
    for (const char* key : {"a", "b", "frame", "last_frame", "distance"})
        if (!json.contains(key)) return false;
    if (!json["a"].is_string() || !json["b"].is_string() || !json["distance"].is_number() ||
        !json["frame"].is_number_unsigned() || !json["last_frame"].is_number_unsigned())
        return false;
    known = {json["a"], json["b"], json["frame"], json["last_frame"], json["distance"]};
    return true;
}

}  // namespace

template <int D>
std::string json_report(const Report<D>& report) {
    Json contacts = Json::array();
    for (const ContactFinding<D>& finding : report.result.findings) contacts.push_back(contact(report, finding));
    Json json = {{"objects", report.objects.size()},
                 {"solids", report.objects.count_solids()},
                 {not_solids<D>, report.objects.size() - report.objects.count_solids()},
                 {"frames", report.times.size()},
                 {"pairs", report.result.tested},
                 {"possible_pairs", report.result.possible},
                 {"swept_pairs", report.result.swept},
                 {"contacts", std::move(contacts)},
                 {"contacts_left_out", report.result.left_out},
                 {"left_out", json_of(report.left_out)},
                 {"warnings", report.notes},
                 {"seconds",
                  {{"read", report.seconds.read},
                   {"build", report.seconds.build},
                   {"check", report.seconds.check},
                   {"level", report.seconds.level}}}};
    json.update(json_of(report.faults, report.level));
    if (report.has_baseline) json["known"] = report.known + report.faults.known;
    return to_text(json);
}
template std::string json_report(const Report<2>& report);
template std::string json_report(const Report<3>& report);

Result<Baseline> read_baseline(const std::filesystem::path& file) {
    const Result<std::vector<std::byte>> bytes = detail::read_file(file);
    if (!bytes) return bytes.problem();
    const auto* text = reinterpret_cast<const char*>(bytes->data());
    Json json = Json::parse(text, text + bytes->size(), nullptr, false);
    const Problem invalid{ProblemCode::bad_format, "is no report of `abut check --json`"};
    if (!json.is_object() || !json.contains("contacts") || !json["contacts"].is_array()) return invalid;
    Baseline result;
    for (const Json& entry : json["contacts"])
        if (!read_known(entry, result.contacts.emplace_back()))
            return Problem{ProblemCode::bad_format,
                           invalid.message + ": contacts[" + std::to_string(result.contacts.size() - 1) + "]"};
    if (const auto left_out = json.find("contacts_left_out"); left_out != json.end() && left_out->is_number_unsigned())
        result.left_out = *left_out;
    result.report = std::move(json);
    return result;
}

}  // namespace abut::tool
