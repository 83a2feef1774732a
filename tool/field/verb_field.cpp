#include "tool/field/field_report.hpp"
#include "tool/objects/level_solid.hpp"
#include "tool/shared/meshes.hpp"
#include "tool/shared/progress.hpp"
#include "tool/shared/stopwatch.hpp"
#include <abut/field/file.hpp>
#include <abut/io/write_file.hpp>

#include <filesystem>
#include <system_error>
#include <utility>

namespace abut::tool {
namespace {

Problem in(const std::string& file, const Problem& problem) {
    return {problem.code, file + ": " + problem.message, problem.index};
}

std::optional<Problem> check_arguments(const FieldRequest& request) {
    if (!request.output.ends_with(field_ending))
        return Problem{ProblemCode::bad_argument, request.output + ": doesn't end in " + std::string(field_ending)};
    std::error_code ignored;
    if (std::filesystem::equivalent(request.output, request.mesh, ignored))
        return Problem{ProblemCode::bad_argument, request.output + ": is the mesh itself, and would be overwritten"};
    if (!request.slices.empty() && !request.picture)
        return Problem{ProblemCode::bad_argument, "--slice needs --picture"};
    if (!request.slices.empty() && dimension_of(request.mesh) == 2)
        return Problem{ProblemCode::bad_argument, "--slice: a 2D level has no slices"};
    return std::nullopt;
}

/// The input of a bake.
template <int D>
struct Source {
    std::size_t parts = 0;
    std::vector<std::string> warnings;
    Baker<D> bake;
    std::vector<std::array<Vec3, 3>> triangles;  ///< for the picture
};

template <int D>
Result<Source<D>> read(const FieldRequest& request);

template <>
Result<Source<3>> read<3>(const FieldRequest& request) {
    Result<Meshes> meshes = load_meshes(request.mesh, request.files);
    if (!meshes) return meshes.problem();
    Geometry whole = detail::merge_meshes(meshes->objects, name_of(request.mesh));
    Source<3> source{whole.triangles.size(), std::move(meshes->warnings), {}, {}};
    for (const glm::uvec3& t : whole.triangles)
        source.triangles.push_back({whole.points[t.x], whole.points[t.y], whole.points[t.z]});
    source.bake = [mesh = std::move(whole)](const FieldOptions<3>& options) {
        return bake_field(mesh.points, mesh.triangles, options);
    };
    return source;
}

template <>
Result<Source<2>> read<2>(const FieldRequest& request) {
    Result<Level> level = load<2>(request.mesh, request.files);
    if (!level) return level.problem();
    const Result<LevelSolid> solid = level_solid(*level);
    if (!solid) return in(request.mesh, solid.problem());
    Source<2> source{level->objects.size(), std::move(level->warnings), {}, {}};
    source.bake = [shape = AnyShape<2>(*solid)](const FieldOptions<2>& options) { return bake_field(shape, options); };
    return source;
}

template <int D>
Result<Field<D>> bake(const FieldRequest& request, const Source<D>& source, Executor& executor, FieldReport& report) {
    Progress progress("baking");
    const auto report_progress = [&](double done) {
        constexpr double steps = 100;
        progress(static_cast<std::size_t>(steps * done), static_cast<std::size_t>(steps));
        return true;
    };
    FieldOptions<D> options;
    options.cell = request.cell;
    options.padding = request.padding;
    options.band = request.band;
    options.store = request.dense ? FieldStore::dense : FieldStore::sparse;
    options.lookup = request.gradient ? FieldLookup::gradient : FieldLookup::linear;
    options.quantised = request.quantised;
    options.executor = &executor;
    options.progress = report_progress;
    options.report = &report;
    return source.bake(options);
}

std::string picture_of(const FieldRequest& request, const Source<3>& source, const Field3& field) {
    return picture(field, source.triangles, request.slices);
}
std::string picture_of(const FieldRequest&, const Source<2>&, const Field2& field) {
    return picture(field);
}

template <int D>
Result<ExitCode> run(const FieldRequest& request) {
    Stopwatch watch;
    Result<Source<D>> source = read<D>(request);
    if (!source) return source.problem();
    const double read_seconds = watch.lap();
    ThreadPool threads;
    FieldReport report;
    const Result<Field<D>> field = bake(request, *source, threads, report);
    if (!field) {
        Problem problem = in(request.mesh, field.problem());
        if (problem.code == ProblemCode::too_large)
            problem.message += ": a larger --cell or a smaller --padding makes fewer";
        return problem;
    }
    FieldOutcome<D> outcome{*field, source->parts, report, {}, 0, source->warnings, read_seconds, watch.lap(), 0, 0};

    const Result<FieldErrors> errors = measure_error<D>(*field, source->bake, &threads);
    if (!errors) return in(request.mesh, errors.problem());
    outcome.errors = *errors;
    outcome.measure_seconds = watch.lap();

    const std::vector<std::byte> bytes = save(*field);
    outcome.file_bytes = bytes.size();
    if (const std::optional<Problem> problem = write_file(request.output, bytes)) return in(request.output, *problem);
    if (request.picture)
        if (std::optional<Problem> problem = write_picture(*request.picture, picture_of(request, *source, *field)))
            return *std::move(problem);
    outcome.write_seconds = watch.lap();
    return print(request.json ? json_report(request, outcome) : text_report(request, outcome),
                 has_uncertain_signs(report) ? found : fine);
}

}  // namespace

Result<ExitCode> run_field(const FieldRequest& request) {
    if (std::optional<Problem> problem = check_arguments(request)) return *std::move(problem);
    return in_dimension_of(request.mesh, [&](auto dimension) { return run<dimension()>(request); });
}

}  // namespace abut::tool
