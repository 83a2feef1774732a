#include "cast_report.hpp"
#include "stopwatch.hpp"
#include "verbs.hpp"

#include <fstream>
#include <utility>

namespace abut::tool {
namespace {

std::optional<Problem> write_file(const std::string& file, const std::string& content) {
    std::ofstream out(file, std::ios::binary);
    out << content;
    out.close();
    if (out) return std::nullopt;
    return Problem{ProblemCode::unreadable, file + ": can't be written"};
}

}  // namespace

Result<ExitCode> run_cast(const CastRequest& request) {
    if (request.options.from == request.options.to)
        return Problem{ProblemCode::bad_argument, "--from and --to are the same place"};
    Stopwatch watch;
    const Result<Scene> scene = load(request.scene, request.skip_degenerate);
    if (!scene) return scene.problem();
    const double read_seconds = watch.lap();
    Objects objects(*scene);
    if (const std::optional<Problem> problem = build(objects, key_times(*scene).front()))
        return Problem{problem->code, request.scene + ": " + problem->message};
    const double build_seconds = watch.lap();

    CastResult result = [&] {
        Progress progress("casting");
        return cast(objects, request.options, progress);
    }();
    CastReport report{objects, request.options, std::move(result), scene->warnings, read_seconds, build_seconds, 0};
    report.cast_seconds = watch.lap();
    if (request.picture)
        if (const std::optional<Problem> problem = write_file(*request.picture, picture(report))) return *problem;
    return print(request.json ? json_report(report) : text_report(report, request.scene),
                 report.result.hits.empty() ? fine : found);
}

}  // namespace abut::tool
