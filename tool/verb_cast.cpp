#include "cast_report.hpp"
#include "stopwatch.hpp"
#include "verbs.hpp"
#include "written.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

std::optional<Problem> write_file(const std::string& file, const std::string& content) {
    std::ofstream out(file, std::ios::binary);
    out << content;
    out.close();
    if (out) return std::nullopt;
    return Problem{ProblemCode::unreadable, file + ": can't be written"};
}

/// Reports write moments with four digits, and what they write can be asked about.
constexpr double rounded_off = 5e-4;

/// The moment at which the scene is taken.
Result<double> moment(const Scene& scene, const std::optional<double>& asked) {
    const std::vector<double> keys = key_times(scene);
    const double first = keys.front(), last = keys.back();
    if (!asked) return first;
    const double slack = rounded_off * std::max(std::abs(first), std::abs(last));
    if (*asked >= first - slack && *asked <= last + slack) return std::clamp(*asked, first, last);
    const std::string why = first < last ? fmt::format("{} s is not in the animation, which is from {} s to {} s",
                                                       number(*asked), number(first), number(last))
                                         : "nothing moves, so the first moment is the only one";
    return Problem{ProblemCode::bad_argument, "--time: " + why};
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
    const Result<double> time = moment(*scene, request.time);
    if (!time) return Problem{time.problem().code, request.scene + ": " + time.problem().message};
    if (const std::optional<Problem> problem = build(objects, *time))
        return Problem{problem->code, request.scene + ": " + problem->message};
    const double build_seconds = watch.lap();

    CastResult result = [&] {
        Progress progress("casting");
        return cast(objects, request.options, progress);
    }();
    CastReport report{objects,         request.options, *time,         std::move(result),
                      scene->warnings, read_seconds,    build_seconds, 0};
    report.cast_seconds = watch.lap();
    if (request.picture)
        if (const std::optional<Problem> problem = write_file(*request.picture, picture(report))) return *problem;
    return print(request.json ? json_report(report) : text_report(report, request.scene),
                 report.result.hits.empty() ? fine : found);
}

}  // namespace abut::tool
