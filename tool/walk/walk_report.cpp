#include "tool/walk/walk_report.hpp"

#include "tool/shared/format.hpp"
#include <abut/math/dvec.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace abut::tool {

using namespace detail;

namespace {

constexpr std::size_t max_listed_areas = 20, max_listed_points = 100;

Vec3 middle(const Aabb3& box) {
    return to_float((DVec<3>(box.min) + DVec<3>(box.max)) * 0.5);
}
Aabb3 box_of(const WalkBorder& border) {
    Aabb3 box = Aabb3::empty();
    for (const Vec3& point : border.points) box = merged(box, Aabb3{point, point});
    return box;
}
Vec3 middle(const WalkEdge& edge) {
    return middle(merged(Aabb3{edge.from, edge.from}, Aabb3{edge.to, edge.to}));
}

/// "rim 24 long, 2 holes: 4 round (1, 0, 2), 6 round (5, 0, 2)"
std::string borders_line(const WalkSurvey& survey, std::uint32_t component) {
    std::vector<const WalkBorder*> holes;
    std::string text = "closed, without a border";
    for (const WalkBorder& border : survey.borders) {
        if (border.component != component) continue;
        if (border.is_rim)
            text = "rim " + number(border.length) + " long";
        else
            holes.push_back(&border);
    }
    if (holes.empty()) return text;
    text += ", " + counted(holes.size(), "hole", "holes") + ": ";
    for (std::size_t i = 0; i < holes.size() && i < max_listed_areas; ++i)
        text += (i == 0 ? "" : ", ") + number(holes[i]->length) + " round " + vector(middle(box_of(*holes[i])));
    if (holes.size() > max_listed_areas) text += fmt::format(", and {} more", holes.size() - max_listed_areas);
    return text;
}

std::string components_text(const WalkSurvey& survey) {
    std::string text;
    for (std::uint32_t i = 0; i < survey.components.size() && i < max_listed_areas; ++i) {
        const WalkComponent& component = survey.components[i];
        text += fmt::format("component {:<2}{}, area {}, from {} to {}\n", i,
                            counted(component.triangles, "triangle", "triangles"), number(component.area),
                            vector(component.box.min), vector(component.box.max));
        text += "            " + borders_line(survey, i) + "\n";
    }
    if (survey.components.size() > max_listed_areas)
        text += fmt::format("            and {} more (--json lists them all)\n",
                            survey.components.size() - max_listed_areas);
    return text;
}

/// "vertices    2 non-manifold vertices: (0, 0, 1), (4, 0, 1)"
template <class Items, class Place>
std::string places_line(const char* title, const Items& items, const char* one, const char* many, Place place) {
    if (items.empty()) return {};
    std::string text = fmt::format("{:<12}{}: ", title, counted(items.size(), one, many));
    for (std::size_t i = 0; i < items.size() && i < max_listed_areas; ++i)
        text += (i == 0 ? "" : ", ") + vector(place(items[i]));
    if (items.size() > max_listed_areas) text += fmt::format(", and {} more", items.size() - max_listed_areas);
    return text + "\n";
}

std::string faults_text(const WalkSurvey& survey) {
    const auto point = [](const Vec3& p) { return p; };
    const auto edge = [](const WalkEdge& e) { return middle(e); };
    return places_line("vertices", survey.non_manifold_vertices, "non-manifold vertex", "non-manifold vertices",
                       point) +
           places_line("edges", survey.non_manifold_edges, "non-manifold edge", "non-manifold edges", edge) +
           places_line("mirrored", survey.mirrored, "edge of inconsistent orientation",
                       "edges of inconsistent orientation", edge);
}

std::string end_line(const char* title, const WalkMesh& mesh, const WalkEnd& end) {
    return fmt::format("{:<12}{}: on triangle {} of component {} at {}, {} off\n", title, vector(end.requested),
                       end.place.triangle, mesh.component(end.place.triangle), vector(end.point), number(end.distance));
}

std::string path_text(const WalkPath& path) {
    std::string text;
    for (std::size_t i = 0; i < path.points.size() && i < max_listed_points; ++i)
        text += fmt::format("{:4}. {}\n", i + 1, vector(path.points[i]));
    if (path.points.size() > max_listed_points)
        text += fmt::format("      and {} more (--json lists them all)\n", path.points.size() - max_listed_points);
    return text + "\n";
}

std::string verdict(const WalkRequest& request, const WalkOutcome& outcome) {
    const WalkEnd &from = *outcome.from, &to = *outcome.to;
    for (const WalkEnd* end : {&from, &to})
        if (is_beyond(request, *end))
            return fmt::format("NO PATH: {} is {} off the mesh, farther than {}\n", vector(end->requested),
                               number(end->distance), number(static_cast<double>(*request.reach)));
    if (outcome.path)
        return fmt::format("PATH: {} long, from {} to {}\n", number(outcome.path->length), vector(from.point),
                           vector(to.point));
    return fmt::format("NO PATH: {} is on component {}, {} on component {}\n", vector(from.point),
                       outcome.mesh.component(from.place.triangle), vector(to.point),
                       outcome.mesh.component(to.place.triangle));
}

Json json_of(const WalkMeshReport& report) {
    return {{"doubled", report.duplicates},
            {"flat", report.flat},
            {"left_out", report.left_out},
            {"turned", report.turned},
            {"crowded", report.non_manifold_edges},
            {"mirrored", report.mirrored},
            {"border", report.border},
            {"pinched", report.non_manifold_vertices},
            {"islands", report.components}};
}

Json json_of(const std::vector<Vec3>& points) {
    Json list = Json::array();
    for (const Vec3& point : points) list.push_back(numbers(point));
    return list;
}
Json json_of(const std::vector<WalkEdge>& edges) {
    Json list = Json::array();
    for (const WalkEdge& edge : edges) list.push_back({{"from", numbers(edge.from)}, {"to", numbers(edge.to)}});
    return list;
}

Json json_of(const WalkMesh& mesh, const WalkEnd& end) {
    return {{"asked", numbers(end.requested)},
            {"point", numbers(end.point)},
            {"off", end.distance},
            {"triangle", end.place.triangle},
            {"weights", numbers(end.place.weights)},
            {"island", mesh.component(end.place.triangle)}};
}

Json components_json(const WalkOutcome& outcome) {
    Json list = Json::array();
    for (const WalkComponent& component : outcome.survey.components)
        list.push_back({{"triangles", component.triangles},
                        {"area", component.area},
                        {"place", numbers(outcome.mesh.to_world(component.place))},
                        {"min", numbers(component.box.min)},
                        {"max", numbers(component.box.max)}});
    return list;
}
Json borders_json(const WalkSurvey& survey) {
    Json list = Json::array();
    for (const WalkBorder& border : survey.borders)
        list.push_back({{"island", border.component},
                        {"length", border.length},
                        {"rim", border.is_rim},
                        {"points", json_of(border.points)}});
    return list;
}

}  // namespace

std::string text_report(const WalkRequest& request, const WalkOutcome& outcome) {
    std::string text = request.mesh + (request.output ? " -> " + *request.output : "") + "\n\n";
    for (const std::string& warning : outcome.warnings) text += "note: " + warning + "\n";
    text += fmt::format("mesh        {} of {}: {}\n", counted(outcome.mesh.triangles().size(), "triangle", "triangles"),
                        outcome.objects.empty() ? "a baked mesh" : counted(outcome.objects.size(), "object", "objects"),
                        described(outcome.mesh.report()));
    text += components_text(outcome.survey) + faults_text(outcome.survey);
    if (request.output) text += fmt::format("file        {} bytes\n", outcome.file_bytes);
    if (outcome.from) {
        text += end_line("from", outcome.mesh, *outcome.from) + end_line("to", outcome.mesh, *outcome.to);
        if (outcome.path) text += "\n" + path_text(*outcome.path);
    }
    text += fmt::format("time        {} s to read, {} to survey, {} to find the path, {} to write\n",
                        number(outcome.read_seconds), number(outcome.survey_seconds), number(outcome.find_seconds),
                        number(outcome.write_seconds));
    return outcome.from ? text + "\n" + verdict(request, outcome) : text;
}

std::string json_report(const WalkRequest& request, const WalkOutcome& outcome) {
    const WalkMesh& mesh = outcome.mesh;
    Json json = {{"triangles", mesh.triangles().size()},
                 {"points", mesh.points().size()},
                 {"objects", outcome.objects},
                 {"report", json_of(mesh.report())},
                 {"islands", components_json(outcome)},
                 {"borders", borders_json(outcome.survey)},
                 {"pinched", json_of(outcome.survey.non_manifold_vertices)},
                 {"crowded", json_of(outcome.survey.non_manifold_edges)},
                 {"mirrored", json_of(outcome.survey.mirrored)}};
    if (outcome.from) {
        json["from"] = json_of(mesh, *outcome.from);
        json["to"] = json_of(mesh, *outcome.to);
        json["way"] = nullptr;
        if (outcome.path) json["way"] = {{"length", outcome.path->length}, {"points", json_of(outcome.path->points)}};
    }
    if (request.output) {
        json["output"] = *request.output;
        json["file_bytes"] = outcome.file_bytes;
    }
    json["warnings"] = outcome.warnings;
    json["seconds"] = {{"read", outcome.read_seconds},
                       {"survey", outcome.survey_seconds},
                       {"find", outcome.find_seconds},
                       {"write", outcome.write_seconds}};
    return to_text(json);
}

}  // namespace abut::tool
