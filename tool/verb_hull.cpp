#include "tool/shared/format.hpp"
#include "tool/shared/meshes.hpp"
#include "tool/shared/progress.hpp"
#include "tool/shared/stopwatch.hpp"
#include "tool/verbs.hpp"
#include <abut/io/write_mesh.hpp>
#include <abut/shape/polyhedron.hpp>

#include <utility>
#include <vector>

#include <fmt/format.h>

namespace abut::tool {
namespace {

struct NamedHull {
    std::string name;
    std::size_t points = 0;  ///< count of input points
    Polyhedron hull;
    double added = 0;  ///< distance added by the vertex limit
};

struct HullReport {
    std::vector<NamedHull> hulls;
    std::vector<std::string> warnings;
    double read_seconds = 0, hull_seconds = 0, write_seconds = 0;
};

Result<std::vector<NamedHull>> hulls_of(const HullRequest& request, const std::vector<Geometry>& objects) {
    std::vector<NamedHull> result;
    Progress progress("hulls");
    for (const Geometry& object : objects) {
        NamedHull next{object.name, object.points.size(), {}, 0};
        const Result<Polyhedron> hull =
            Polyhedron::build(object.points, {.max_vertices = request.max_vertices, .added = &next.added});
        const std::string where = request.mesh + ": object '" + object.name + "': ";
        if (!hull) return Problem{hull.problem().code, where + hull.problem().message};
        if (hull->rank() < 2)
            return Problem{ProblemCode::degenerate,
                           where + "all its points are collinear, so that its hull would be a segment"};
        next.hull = *hull;
        result.push_back(std::move(next));
        progress(result.size(), objects.size());
    }
    return result;
}

std::string text_report(const HullRequest& request, const HullReport& report) {
    std::string text = fmt::format("{} -> {}\n\n  {:>8}  {:>8}  {:>8}  {:>10}  {:>8}\n", request.mesh, request.output,
                                   "points", "vertices", "faces", "volume", "added");
    for (std::size_t i = 0; i < report.hulls.size() && i < max_listed; ++i) {
        const NamedHull& hull = report.hulls[i];
        text += fmt::format("  {:8}  {:8}  {:8}  {:>10}  {:>8}  {}\n", hull.points, hull.hull.points().size(),
                            hull.hull.facets().normals.size(), number(hull.hull.volume()),
                            hull.added == 0 ? "-" : number(hull.added), hull.name);
    }
    if (report.hulls.size() > max_listed)
        text += fmt::format("  and {} more (--json lists them all)\n", report.hulls.size() - max_listed);
    text += "\n";
    for (const std::string& warning : report.warnings) text += "note: " + warning + "\n";
    return text + fmt::format("{}; read in {} s, built in {} s, written in {} s\n",
                              counted(report.hulls.size(), "hull", "hulls"), number(report.read_seconds),
                              number(report.hull_seconds), number(report.write_seconds));
}

std::string json_report(const HullRequest& request, const HullReport& report) {
    Json hulls = Json::array();
    double volume = 0;
    std::size_t vertices = 0;
    for (const NamedHull& hull : report.hulls) {
        hulls.push_back({{"name", hull.name},
                         {"points", hull.points},
                         {"vertices", hull.hull.points().size()},
                         {"faces", hull.hull.facets().normals.size()},
                         {"flat", hull.hull.rank() < 3},
                         {"volume", hull.hull.volume()},
                         {"area", hull.hull.area()},
                         {"added", hull.added}});
        volume += hull.hull.volume();
        vertices += hull.hull.points().size();
    }
    const Json json = {
        {"output", request.output},
        {"hulls", std::move(hulls)},
        {"vertices", vertices},
        {"volume", volume},
        {"warnings", report.warnings},
        {"seconds", {{"read", report.read_seconds}, {"build", report.hull_seconds}, {"write", report.write_seconds}}}};
    return to_text(json);
}

}  // namespace

Result<ExitCode> run_hull(const HullRequest& request) {
    if (std::optional<Problem> problem = check_output(request.output, request.mesh)) return *std::move(problem);
    Stopwatch watch;
    Result<Meshes> meshes = load_meshes(request.mesh, request.files);
    if (!meshes) return meshes.problem();
    if (!request.each) meshes->objects = {detail::merge_meshes(meshes->objects, name_of(request.mesh))};
    HullReport report{{}, meshes->warnings, watch.lap(), 0, 0};
    Result<std::vector<NamedHull>> hulls = hulls_of(request, meshes->objects);
    if (!hulls) return hulls.problem();
    report.hulls = *std::move(hulls);
    report.hull_seconds = watch.lap();
    std::vector<Geometry> output;
    for (const NamedHull& hull : report.hulls) output.push_back(mesh_of(hull.hull, hull.name));
    if (std::optional<Problem> problem = write_output(request.output, output)) return *std::move(problem);
    report.write_seconds = watch.lap();
    return print(request.json ? json_report(request, report) : text_report(request, report), fine);
}

}  // namespace abut::tool
