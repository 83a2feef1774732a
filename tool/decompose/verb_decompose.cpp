#include "tool/decompose/decompose_report.hpp"
#include "tool/shared/meshes.hpp"
#include "tool/shared/progress.hpp"
#include "tool/shared/stopwatch.hpp"
#include <abut/io/write_mesh.hpp>

#include <utility>

namespace abut::tool {
namespace {

Result<std::vector<Polyhedron>> parts_of(const DecomposeRequest& request, const Repaired& mesh,
                                         DecomposeReport& report) {
    Progress progress("decomposing");
    const auto report_progress = [&](double done) {
        constexpr double steps = 100;
        progress(static_cast<std::size_t>(steps * done), static_cast<std::size_t>(steps));
        return true;
    };
    DecomposeOptions options;
    options.max_parts = request.max_parts;
    options.concavity = request.concavity;
    options.max_vertices = request.max_vertices;
    options.progress = report_progress;
    options.report = &report;
    return decompose(mesh.points, mesh.triangles, options);
}

Problem in(const std::string& file, const Problem& problem) {
    return {problem.code, file + ": " + problem.message, problem.index};
}

}  // namespace

Result<ExitCode> run_decompose(const DecomposeRequest& request) {
    if (std::optional<Problem> problem = check_output(request.output, request.mesh)) return *std::move(problem);
    Stopwatch watch;
    Result<Meshes> meshes = load_meshes(request.mesh, request.files);
    if (!meshes) return meshes.problem();
    const Geometry whole = detail::merge_meshes(meshes->objects, name_of(request.mesh));
    DecomposeOutcome outcome;
    outcome.warnings = meshes->warnings;
    outcome.triangles = whole.triangles.size();
    outcome.read_seconds = watch.lap();

    const Result<Repaired> mesh = repair(whole.points, whole.triangles, {.face_outwards = !request.rooms});
    if (!mesh) return in(request.mesh, mesh.problem());
    outcome.repairs = mesh->repairs;
    outcome.repair_seconds = watch.lap();

    const Result<std::vector<Polyhedron>> parts = parts_of(request, *mesh, outcome.whole);
    if (!parts) return in(request.mesh, parts.problem());
    outcome.decompose_seconds = watch.lap();

    std::vector<Geometry> output;
    for (std::size_t i = 0; i < parts->size(); ++i) {
        const Polyhedron& part = (*parts)[i];
        const std::string name = whole.name + "_" + std::to_string(i);
        outcome.parts.push_back({name, part, outcome.whole.concavity[i], fit(part)});
        if (part.rank() >= 2) output.push_back(mesh_of(part, name));
    }
    if (std::optional<Problem> problem = write_output(request.output, output)) return *std::move(problem);
    if (request.picture)
        if (std::optional<Problem> problem = write_picture(*request.picture, picture(outcome.parts)))
            return *std::move(problem);
    outcome.write_seconds = watch.lap();
    return print(request.json ? json_report(request, outcome) : text_report(request, outcome), fine);
}

}  // namespace abut::tool
