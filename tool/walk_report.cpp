#include "walk_report.hpp"

#include "written.hpp"
#include <abut/math/dvec.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace abut::tool {
namespace {

constexpr std::size_t most_lines = 20, most_corners = 100;

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

/// "rim 24 long, 2 holes: 4 round about (1, 0, 2), 6 round about (5, 0, 2)"
std::string borders_line(const WalkSurvey& survey, std::uint32_t island) {
    std::vector<const WalkBorder*> holes;
    std::string text = "closed, without a border";
    for (const WalkBorder& border : survey.borders) {
        if (border.island != island) continue;
        if (border.is_rim)
            text = "rim " + number(border.length) + " long";
        else
            holes.push_back(&border);
    }
    if (holes.empty()) return text;
    text += ", " + counted(holes.size(), "hole", "holes") + ": ";
    for (std::size_t i = 0; i < holes.size() && i < most_lines; ++i)
        text += (i == 0 ? "" : ", ") + number(holes[i]->length) + " round " + vector(middle(box_of(*holes[i])));
    if (holes.size() > most_lines) text += fmt::format(", and {} more", holes.size() - most_lines);
    return text;
}

std::string islands_text(const WalkSurvey& survey) {
    std::string text;
    for (std::uint32_t i = 0; i < survey.islands.size() && i < most_lines; ++i) {
        const WalkIsland& island = survey.islands[i];
        text += fmt::format("island {:<5}{}, area {}, from {} to {}\n", i,
                            counted(island.triangles, "triangle", "triangles"), number(island.area),
                            vector(island.box.min), vector(island.box.max));
        text += "            " + borders_line(survey, i) + "\n";
    }
    if (survey.islands.size() > most_lines)
        text += fmt::format("            and {} more (--json lists them all)\n", survey.islands.size() - most_lines);
    return text;
}

/// "pinched     2 points: (0, 0, 1), (4, 0, 1)"
template <class Things, class Place>
std::string places_line(const char* title, const Things& things, const char* one, const char* many, Place place) {
    if (things.empty()) return {};
    std::string text = fmt::format("{:<12}{}: ", title, counted(things.size(), one, many));
    for (std::size_t i = 0; i < things.size() && i < most_lines; ++i)
        text += (i == 0 ? "" : ", ") + vector(place(things[i]));
    if (things.size() > most_lines) text += fmt::format(", and {} more", things.size() - most_lines);
    return text + "\n";
}

std::string faults_text(const WalkSurvey& survey) {
    const auto point = [](const Vec3& p) { return p; };
    const auto edge = [](const WalkEdge& e) { return middle(e); };
    return places_line("pinched", survey.pinched, "point that nobody gets through", "points that nobody gets through",
                       point) +
           places_line("crowded", survey.crowded, "edge of more than two triangles", "edges of more than two triangles",
                       edge) +
           places_line("mirrored", survey.mirrored, "edge where the surface turns over",
                       "edges where the surface turns over", edge);
}

std::string end_line(const char* title, const WalkMesh& mesh, const WalkEnd& end) {
    return fmt::format("{:<12}{}: on triangle {} of island {} at {}, {} off\n", title, vector(end.asked),
                       end.place.triangle, mesh.island(end.place.triangle), vector(end.point), number(end.off));
}

std::string way_text(const WalkPath& way) {
    std::string text;
    for (std::size_t i = 0; i < way.points.size() && i < most_corners; ++i)
        text += fmt::format("{:4}. {}\n", i + 1, vector(way.points[i]));
    if (way.points.size() > most_corners)
        text += fmt::format("      and {} more (--json lists them all)\n", way.points.size() - most_corners);
    return text + "\n";
}

std::string verdict(const WalkRequest& request, const WalkOutcome& outcome) {
    const WalkEnd &from = *outcome.from, &to = *outcome.to;
    for (const WalkEnd* end : {&from, &to})
        if (is_beyond(request, *end))
            return fmt::format("NO WAY: {} is {} off the mesh, farther than {}\n", vector(end->asked), number(end->off),
                               number(static_cast<double>(*request.reach)));
    if (outcome.way)
        return fmt::format("WAY: {} long, from {} to {}\n", number(outcome.way->length), vector(from.point),
                           vector(to.point));
    return fmt::format("NO WAY: {} is on island {}, {} on island {}\n", vector(from.point),
                       outcome.mesh.island(from.place.triangle), vector(to.point),
                       outcome.mesh.island(to.place.triangle));
}

Json json_of(const WalkMeshReport& report) {
    return {{"doubled", report.doubled}, {"flat", report.flat},       {"left_out", report.left_out},
            {"turned", report.turned},   {"crowded", report.crowded}, {"mirrored", report.mirrored},
            {"border", report.border},   {"pinched", report.pinched}, {"islands", report.islands}};
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
    return {{"asked", numbers(end.asked)},
            {"point", numbers(end.point)},
            {"off", end.off},
            {"triangle", end.place.triangle},
            {"weights", numbers(end.place.weights)},
            {"island", mesh.island(end.place.triangle)}};
}

Json islands_json(const WalkOutcome& outcome) {
    Json list = Json::array();
    for (const WalkIsland& island : outcome.survey.islands)
        list.push_back({{"triangles", island.triangles},
                        {"area", island.area},
                        {"place", numbers(outcome.mesh.to_world(island.place))},
                        {"min", numbers(island.box.min)},
                        {"max", numbers(island.box.max)}});
    return list;
}
Json borders_json(const WalkSurvey& survey) {
    Json list = Json::array();
    for (const WalkBorder& border : survey.borders)
        list.push_back({{"island", border.island},
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
    text += islands_text(outcome.survey) + faults_text(outcome.survey);
    if (request.output) text += fmt::format("file        {} bytes\n", outcome.file_bytes);
    if (outcome.from) {
        text += end_line("from", outcome.mesh, *outcome.from) + end_line("to", outcome.mesh, *outcome.to);
        if (outcome.way) text += "\n" + way_text(*outcome.way);
    }
    text += fmt::format("time        {} s to read, {} to survey, {} to find the way, {} to write\n",
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
                 {"islands", islands_json(outcome)},
                 {"borders", borders_json(outcome.survey)},
                 {"pinched", json_of(outcome.survey.pinched)},
                 {"crowded", json_of(outcome.survey.crowded)},
                 {"mirrored", json_of(outcome.survey.mirrored)}};
    if (outcome.from) {
        json["from"] = json_of(mesh, *outcome.from);
        json["to"] = json_of(mesh, *outcome.to);
        json["way"] = nullptr;
        if (outcome.way) json["way"] = {{"length", outcome.way->length}, {"points", json_of(outcome.way->points)}};
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
    return written(json);
}

}  // namespace abut::tool
