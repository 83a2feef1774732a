#include "tool/decompose/decompose_report.hpp"

#include "tool/shared/format.hpp"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

namespace abut::tool {
namespace {

const char* kind_of(const Fit& fit) {
    constexpr const char* kinds[] = {"ball", "capsule", "box"};
    return kinds[fit.shape.index()];
}

/// ": a box", or ": nearly a box, 0.01 off".
std::string likeness(const PartReport& report) {
    constexpr double rounding = 1e-5;
    if (!report.fit) return "";
    const bool is_one = report.fit->error <= rounding * report.part.ball().radius;
    return is_one ? fmt::format(": a {}", kind_of(*report.fit))
                  : fmt::format(": nearly a {}, {} off", kind_of(*report.fit), number(report.fit->error));
}

void add(Json& json, const Ball<3>& ball) {
    json["center"] = numbers(ball.center);
    json["radius"] = ball.radius;
}
void add(Json& json, const Capsule<3>& capsule) {
    json["a"] = numbers(capsule.a);
    json["b"] = numbers(capsule.b);
    json["radius"] = capsule.radius;
}
void add(Json& json, const Box<3>& box) {
    json["center"] = numbers(box.center);
    json["half"] = numbers(box.half);
    json["rotation"] = {box.rotation.x, box.rotation.y, box.rotation.z, box.rotation.w};
}

Json json_of(const std::optional<Fit>& fit) {
    if (!fit) return nullptr;
    Json json = {{"kind", kind_of(*fit)}, {"error", fit->error}, {"contains", fit->contains}};
    std::visit([&](const auto& shape) { add(json, shape); }, fit->shape);
    return json;
}

Json json_of(const Repairs& repairs) {
    return {{"points_joined", repairs.points_joined},
            {"points_welded", repairs.points_welded},
            {"points_unused", repairs.points_unused},
            {"triangles_lost", repairs.triangles_lost},
            {"triangles_double", repairs.triangles_double},
            {"triangles_turned", repairs.triangles_turned},
            {"holes_filled", repairs.holes_filled},
            {"triangles_added", repairs.triangles_added},
            {"cavities", repairs.cavities},
            {"rooms", repairs.rooms},
            {"open_edges", repairs.open_edges},
            {"crowded_edges", repairs.non_manifold_edges},
            {"disagreeing_edges", repairs.disagreeing_edges}};
}

/// The excess volume of the parts as a fraction of the mesh's volume; nothing if the mesh encloses no volume.
std::optional<double> extra(const DecomposeReport& whole) {
    if (!whole.closed || !(whole.mesh_volume > 0)) return std::nullopt;
    return whole.parts_volume / whole.mesh_volume - 1;
}

std::size_t most_vertices(const std::vector<PartReport>& parts) {
    std::size_t max_count = 0;
    for (const PartReport& part : parts) max_count = std::max(max_count, part.part.points().size());
    return max_count;
}

}  // namespace

std::string text_report(const DecomposeRequest& request, const DecomposeOutcome& outcome) {
    std::string text = fmt::format("{} -> {}\n\n  {:>8}  {:>6}  {:>10}  {:>9}\n", request.mesh, request.output,
                                   "vertices", "faces", "volume", "concavity");
    for (std::size_t i = 0; i < outcome.parts.size() && i < max_listed; ++i) {
        const PartReport& report = outcome.parts[i];
        text += fmt::format("  {:8}  {:6}  {:>10}  {:>9}  {}{}\n", report.part.points().size(),
                            report.part.facets().normals.size(), number(report.part.volume()), number(report.concavity),
                            report.name, likeness(report));
    }
    if (outcome.parts.size() > max_listed)
        text += fmt::format("  and {} more (--json lists them all)\n", outcome.parts.size() - max_listed);
    text += "\n";
    for (const std::string& warning : outcome.warnings) text += "note: " + warning + "\n";
    const DecomposeReport& whole = outcome.whole;
    text += fmt::format("mesh        {}: {}\n", counted(outcome.triangles, "triangle", "triangles"),
                        described(outcome.repairs));
    text += fmt::format("parts       {}, {} vertices, at most {} each\n", outcome.parts.size(), whole.vertices,
                        most_vertices(outcome.parts));
    if (const std::optional<double> more = extra(whole))
        text +=
            fmt::format("volume      {} in the mesh, {} in its parts, {:+.1f} %, where parts overlap counted twice\n",
                        number(whole.mesh_volume), number(whole.parts_volume), 100 * *more);
    else
        text += fmt::format("volume      {} in the parts; the mesh is not closed and has none\n",
                            number(whole.parts_volume));
    text += fmt::format("uncovered   every point of the surface is within {} of the parts\n", number(whole.farthest));
    return text + fmt::format("time        {} s to read, {} to repair, {} to decompose, {} to write\n",
                              number(outcome.read_seconds), number(outcome.repair_seconds),
                              number(outcome.decompose_seconds), number(outcome.write_seconds));
}

std::string json_report(const DecomposeRequest& request, const DecomposeOutcome& outcome) {
    Json parts = Json::array();
    for (const auto& [name, part, concavity, fit] : outcome.parts)
        parts.push_back({{"name", name},
                         {"vertices", part.points().size()},
                         {"faces", part.facets().normals.size()},
                         {"flat", part.rank() < 3},
                         {"volume", part.volume()},
                         {"concavity", concavity},
                         {"fit", json_of(fit)}});
    const DecomposeReport& whole = outcome.whole;
    const std::optional<double> more = extra(whole);
    Json json = {
        {"output", request.output},    {"triangles", outcome.triangles},     {"repairs", json_of(outcome.repairs)},
        {"closed", whole.closed},      {"parts", std::move(parts)},          {"vertices", whole.vertices},
        {"volume", whole.mesh_volume}, {"parts_volume", whole.parts_volume}, {"extra", more ? Json(*more) : Json()},
        {"uncovered", whole.farthest}, {"warnings", outcome.warnings}};
    json["seconds"] = {{"read", outcome.read_seconds},
                       {"repair", outcome.repair_seconds},
                       {"decompose", outcome.decompose_seconds},
                       {"write", outcome.write_seconds}};
    return to_text(json);
}

}  // namespace abut::tool
