#include "tool/shared/files.hpp"
#include "tool/shared/import_in_child.hpp"
#include "tool/shared/stopwatch.hpp"
#include "tool/walk/walk_report.hpp"
#include <abut/io/file/read_file.hpp>
#include <abut/io/read_walk_mesh.hpp>
#include <abut/io/write_file.hpp>
#include <abut/math/dvec.hpp>
#include <abut/walk/file.hpp>

#include <filesystem>
#include <system_error>
#include <utility>

namespace abut::tool {

using namespace detail;

namespace {

Problem in(const std::string& file, const Problem& problem) {
    return {problem.code, file + ": " + problem.message, problem.index};
}

std::optional<Problem> check_arguments(const WalkRequest& request) {
    const auto bad = [](std::string message) { return Problem{ProblemCode::bad_argument, std::move(message)}; };
    if (request.from.has_value() != request.to.has_value())
        return bad(request.from ? "--from needs --to" : "--to needs --from");
    if (request.reach && !request.from) return bad("--reach needs --from and --to");
    if (!request.output) return std::nullopt;
    if (!request.output->ends_with(walk_ending))
        return bad(*request.output + ": doesn't end in " + std::string(walk_ending));
    std::error_code ignored;
    if (std::filesystem::equivalent(*request.output, request.mesh, ignored))
        return bad(*request.output + ": is the mesh itself, and would be overwritten");
    return std::nullopt;
}

/// Reads a baked mesh, or builds one from a scene.
Result<NamedWalkMesh> read(const WalkRequest& request) {
    if (dimension_of(request.mesh) == 2)
        return Problem{ProblemCode::bad_argument, request.mesh + ": is a 2D level, and has no meshes"};
    const Result<std::vector<std::byte>> bytes = read_file(request.mesh);
    if (!bytes) return in(request.mesh, bytes.problem());
    if (is_walk_mesh(*bytes)) {
        if (!request.name.empty())
            return Problem{ProblemCode::bad_argument, request.mesh + ": is baked, and has no names for --name"};
        Result<WalkMesh> mesh = load_walk_mesh(*bytes);
        if (!mesh) return in(request.mesh, mesh.problem());
        return NamedWalkMesh{*std::move(mesh), {}, {}};
    }
    ReadOptions options = walk_mesh_options;
    options.allow_outside = request.files.allow_outside;
    Result<Scene> scene = import_in_child(request.mesh, options, limits_for(request.mesh));
    if (!scene)
        return Problem{scene.problem().code, request.mesh + ": " + scene.problem().message + hint(scene.problem())};
    Result<NamedWalkMesh> named = walk_mesh_of(*scene, request.name);
    if (!named) return in(request.mesh, named.problem());
    scene->warnings.insert(scene->warnings.end(), named->warnings.begin(), named->warnings.end());
    named->warnings = std::move(scene->warnings);
    return named;
}

WalkEnd end_at(const WalkMesh& mesh, const Vec3& requested) {
    WalkEnd end{requested, mesh.nearest(requested), {}, 0};
    end.point = mesh.to_world(end.place);
    end.distance = length(DVec<3>(end.point) - DVec<3>(requested));
    return end;
}

}  // namespace

bool is_beyond(const WalkRequest& request, const WalkEnd& end) {
    return request.reach && end.distance > static_cast<double>(*request.reach);
}

Result<ExitCode> run_walk(const WalkRequest& request) {
    if (std::optional<Problem> problem = check_arguments(request)) return *std::move(problem);
    Stopwatch watch;
    Result<NamedWalkMesh> named = read(request);
    if (!named) return named.problem();
    WalkOutcome outcome{std::move(named->mesh), std::move(named->objects), std::move(named->warnings)};
    outcome.read_seconds = watch.lap();
    outcome.survey = survey(outcome.mesh);
    outcome.survey_seconds = watch.lap();

    if (request.from) {
        outcome.from = end_at(outcome.mesh, *request.from);
        outcome.to = end_at(outcome.mesh, *request.to);
        if (!is_beyond(request, *outcome.from) && !is_beyond(request, *outcome.to))
            outcome.path = outcome.mesh.find_path(outcome.from->place, outcome.to->place);
        outcome.find_seconds = watch.lap();
    }
    if (request.output) {
        const std::vector<std::byte> bytes = save(outcome.mesh);
        outcome.file_bytes = bytes.size();
        if (const std::optional<Problem> problem = write_file(*request.output, bytes))
            return in(*request.output, *problem);
    }
    if (request.picture)
        if (std::optional<Problem> problem = write_picture(*request.picture, picture(outcome)))
            return *std::move(problem);
    outcome.write_seconds = watch.lap();
    return print(request.json ? json_report(request, outcome) : text_report(request, outcome),
                 request.from && !outcome.path ? found : fine);
}

}  // namespace abut::tool
