#include "report_json.hpp"

#include "written.hpp"
#include <abut/io/file_bytes.hpp>

namespace abut::tool {
namespace {

Json contact(const Report& report, const Finding& finding) {
    Json points = Json::array();
    for (const Vec3& point : finding.points) points.push_back(numbers(point));
    Json result = {{"a", report.objects[finding.a].path},
                   {"b", report.objects[finding.b].path},
                   {"frame", finding.first},
                   {"last_frame", finding.last},
                   {"distance", finding.distance},
                   {"normal", numbers(finding.normal)},
                   {"points", std::move(points)},
                   {"deepest_frame", finding.deepest},
                   {"time", report.times[finding.first]},
                   {"last_time", report.times[finding.last]},
                   {"deepest_time", report.times[finding.deepest]}};
    if (finding.inside) result["inside"] = true;
    return result;
}

std::size_t solids(const Objects& objects) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < objects.size(); ++i) count += objects[i].solid ? 1 : 0;
    return count;
}

// A contact of a report, if it has what is needed.
bool read_known(const nlohmann::json& json, KnownFinding& known) {
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

std::string json_report(const Report& report) {
    Json contacts = Json::array();
    for (const Finding& finding : report.result.findings) contacts.push_back(contact(report, finding));
    Json json = {
        {"objects", report.objects.size()},
        {"solids", solids(report.objects)},
        {"meshes", report.objects.size() - solids(report.objects)},
        {"frames", report.times.size()},
        {"pairs", report.result.tested},
        {"possible_pairs", report.result.possible},
        {"contacts", std::move(contacts)},
        {"warnings", report.notes},
        {"seconds", {{"read", report.seconds.read}, {"build", report.seconds.build}, {"check", report.seconds.check}}}};
    if (report.has_baseline) json["known"] = report.known;
    return written(json);
}

Result<std::vector<KnownFinding>> read_baseline(const std::filesystem::path& file) {
    const Result<std::vector<std::byte>> bytes = file_bytes(file);
    if (!bytes) return bytes.problem();
    const auto* text = reinterpret_cast<const char*>(bytes->data());
    const nlohmann::json json = nlohmann::json::parse(text, text + bytes->size(), nullptr, false);
    const Problem no_report{ProblemCode::bad_format, "is no report of `abut check --json`"};
    if (!json.is_object() || !json.contains("contacts") || !json["contacts"].is_array()) return no_report;
    std::vector<KnownFinding> result;
    for (const nlohmann::json& entry : json["contacts"])
        if (!read_known(entry, result.emplace_back()))
            return Problem{ProblemCode::bad_format,
                           no_report.message + ": contacts[" + std::to_string(result.size() - 1) + "]"};
    return result;
}

std::string json_info(const Objects& objects, const Scene& scene, const std::vector<double>& times) {
    Json list = Json::array();
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Object& object = objects[i];
        Json entry = {{"name", object.path},
                      {"kind", object.solid ? "solid" : "mesh"},
                      {"triangles", objects.model_of(object).surface.triangles.size()}};
        if (object.present) {
            entry["min"] = numbers(object.box.min);
            entry["max"] = numbers(object.box.max);
        }
        list.push_back(std::move(entry));
    }
    Json animations = Json::array();
    for (const Animation& animation : scene.animations)
        animations.push_back({{"name", animation.name}, {"start", animation.start}, {"length", animation.length}});
    return written({{"nodes", scene.nodes.size()},
                    {"objects", std::move(list)},
                    {"animations", std::move(animations)},
                    {"frames", times.size()},
                    {"warnings", scene.warnings}});
}

}  // namespace abut::tool
