#include "tool/arguments.hpp"
#include "tool/cast/cast_report.hpp"
#include "tool/shared/format.hpp"
#include "tool/shared/printable.hpp"
#include "tool/shared/stopwatch.hpp"
#include "tool/verbs.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

/// Reports print times with four digits, and such a time must be accepted as input.
constexpr double print_rounding = 5e-4;

/// Checks the requested time, or returns the first time of the scene.
template <class File>
Result<double> parse_time_in(const File& file, const std::optional<double>& requested) {
    const std::vector<double> keys = key_times(file);
    const double first = keys.front(), last = keys.back();
    if (!requested) return first;
    const double tolerance = print_rounding * std::max(std::abs(first), std::abs(last));
    if (*requested >= first - tolerance && *requested <= last + tolerance) return std::clamp(*requested, first, last);
    const std::string why = first < last ? fmt::format("{} s is not in the animation, which is from {} s to {} s",
                                                       number(*requested), number(first), number(last))
                                         : "nothing moves, so the first moment is the only one";
    return Problem{ProblemCode::bad_argument, "--time: " + why};
}

// Parses the end points and options of the ray.
template <int D>
Result<CastOptions<D>> parse_options(const CastRequest& request) {
    CastOptions<D> options;
    options.bounces = request.bounces;
    options.all = request.all;
    for (const auto& [option, text, point] :
         {std::tuple("--from", &request.from, &options.from), std::tuple("--to", &request.to, &options.to)}) {
        const Result<Vec<D>> parsed = parse_point<D>(*text);
        if (!parsed) return Problem{parsed.problem().code, std::string(option) + ": " + parsed.problem().message};
        *point = *parsed;
    }
    if (options.from == options.to) return Problem{ProblemCode::bad_argument, "--from and --to are the same place"};
    return options;
}

template <int D>
Result<ExitCode> run(const CastRequest& request) {
    const Result<CastOptions<D>> options = parse_options<D>(request);
    if (!options) return options.problem();
    Stopwatch watch;
    const Result<File<D>> file = load<D>(request.scene, request.files);
    if (!file) return file.problem();
    const double read_seconds = watch.lap();
    ObjectsOf<D> objects(*file);
    const Result<double> time = parse_time_in(*file, request.time);
    if (!time) return Problem{time.problem().code, request.scene + ": " + time.problem().message};
    if (const std::optional<Problem> problem = build<D>(objects, *time))
        return Problem{problem->code, request.scene + ": " + problem->message};
    const double build_seconds = watch.lap();

    CastResult<D> result = [&] {
        Progress progress("casting");
        return cast<D>(objects, *options, progress);
    }();
    CastReport<D> report{objects,      *options,      *time, std::move(result), file->warnings, left_out_of(*file),
                         read_seconds, build_seconds, 0};
    report.cast_seconds = watch.lap();
    if (request.picture)
        if (const std::optional<Problem> problem = write_picture(*request.picture, picture(report))) return *problem;
    return print(request.json ? json_report(report) : text_report(report, printable(request.scene)),
                 report.result.hits.empty() ? fine : found);
}

}  // namespace

Result<ExitCode> run_cast(const CastRequest& request) {
    return in_dimension_of(request.scene, [&](auto dimension) { return run<dimension()>(request); });
}

}  // namespace abut::tool
