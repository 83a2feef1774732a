// `abut fix`: writes the meshes of a scene without the faults that have one right answer.

#include "tool/shared/format.hpp"
#include "tool/shared/meshes.hpp"
#include "tool/shared/progress.hpp"
#include "tool/shared/stopwatch.hpp"
#include "tool/verbs.hpp"
#include <abut/bake/repair.hpp>

#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

struct FixedObject {
    std::string name;
    bool closed = false;
    Repairs repairs;
};

// Holes stay: what belongs there is the author's to say.
constexpr RepairOptions one_right_answer{.hole_edges = 0};

Result<std::vector<FixedObject>> fix(const FixRequest& request, std::vector<Geometry>& objects) {
    std::vector<FixedObject> result;
    Progress progress("fixing");
    for (Geometry& object : objects) {
        Result<Repaired> repaired = repair(object.points, object.triangles, one_right_answer);
        if (!repaired)
            return Problem{repaired.problem().code,
                           request.mesh + ": object '" + object.name + "': " + repaired.problem().message};
        object.points = std::move(repaired->points);
        object.triangles = std::move(repaired->triangles);
        object.normals.clear();
        result.push_back({object.name, repaired->closed, repaired->repairs});
        progress(result.size(), objects.size());
    }
    return result;
}

std::string text_report(const FixRequest& request, const std::vector<FixedObject>& objects,
                        const std::vector<std::string>& warnings, double seconds) {
    std::string text = fmt::format("{} -> {}\n\n", request.mesh, request.output);
    std::size_t count = 0;
    for (const FixedObject& object : objects) {
        if (!changed(object.repairs)) continue;
        if (++count <= max_listed) text += fmt::format("  {}: {}\n", object.name, described(object.repairs));
    }
    if (count > max_listed) text += fmt::format("  and {} more (--json lists them all)\n", count - max_listed);
    if (count > 0) text += "\n";
    for (const std::string& warning : warnings) text += "note: " + warning + "\n";
    return text + fmt::format("{} of {} changed, in {} s\n", count, counted(objects.size(), "object", "objects"),
                              number(seconds));
}

std::string json_report(const FixRequest& request, const std::vector<FixedObject>& objects,
                        const std::vector<std::string>& warnings) {
    Json list = Json::array();
    for (const FixedObject& object : objects) {
        const Repairs& repairs = object.repairs;
        list.push_back({{"name", object.name},
                        {"changed", changed(repairs)},
                        {"closed", object.closed},
                        {"points_joined", repairs.points_joined},
                        {"triangles_lost", repairs.triangles_lost},
                        {"triangles_double", repairs.triangles_double},
                        {"triangles_turned", repairs.triangles_turned},
                        {"open_edges", repairs.open_edges},
                        {"non_manifold_edges", repairs.non_manifold_edges}});
    }
    return to_text({{"output", request.output}, {"objects", std::move(list)}, {"warnings", warnings}});
}

}  // namespace

Result<ExitCode> run_fix(const FixRequest& request) {
    if (std::optional<Problem> problem = check_output(request.output, request.mesh)) return *std::move(problem);
    Stopwatch watch;
    FileOptions files = request.files;
    files.all_meshes = true;
    Result<Meshes> meshes = load_meshes(request.mesh, files);
    if (!meshes) return meshes.problem();
    const Result<std::vector<FixedObject>> objects = fix(request, meshes->objects);
    if (!objects) return objects.problem();
    if (std::optional<Problem> problem = write_output(request.output, meshes->objects)) return *std::move(problem);
    return print(request.json ? json_report(request, *objects, meshes->warnings)
                              : text_report(request, *objects, meshes->warnings, watch.lap()),
                 fine);
}

}  // namespace abut::tool
