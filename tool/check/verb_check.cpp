#include "tool/arguments.hpp"
#include "tool/check/report.hpp"
#include "tool/check/report_json.hpp"
#include "tool/faults/faults_report.hpp"
#include "tool/shared/progress.hpp"
#include "tool/shared/stopwatch.hpp"
#include "tool/verbs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace abut::tool {
namespace {

// Seconds between frames above which more frames are recommended.
constexpr double max_frame_time = 0.25;
// Limit of the number of frames recommended.
constexpr std::size_t max_advised = 100'000;
static_assert(max_advised <= max_frames);

// A pattern that matches nothing is an error: the check could never fail.
template <int D>
std::optional<Problem> check_patterns(const CheckRequest& request, const Objects<D>& objects) {
    for (const PairPattern& pattern : request.options.pairs)
        for (const std::string& side : {pattern.a, pattern.b}) {
            bool any = false;
            for (std::size_t i = 0; i < objects.size(); ++i) any = any || matches_name(side, objects[i]);
            if (!any)
                return Problem{ProblemCode::bad_argument,
                               request.scene + ": --pairs: no object is named '" + side + "'"};
        }
    return std::nullopt;
}

// Removes findings of the baseline, and returns their count. A finding is new if the pair touches at other frames, or
// deeper by more than the allowed depth.
template <int D>
std::size_t remove_known(std::vector<ContactFinding<D>>& findings, const std::vector<KnownFinding>& known,
                         const Objects<D>& objects) {
    std::map<std::pair<std::string, std::string>, std::vector<const KnownFinding*>> of_pair;
    for (const KnownFinding& old : known) of_pair[{old.a, old.b}].push_back(&old);
    return std::erase_if(findings, [&](const ContactFinding<D>& finding) {
        const auto olds = of_pair.find({objects[finding.a].path, objects[finding.b].path});
        return olds != of_pair.end() &&
               std::any_of(olds->second.begin(), olds->second.end(), [&](const KnownFinding* old) {
                   return old->first <= finding.last && finding.first <= old->last &&
                          static_cast<double>(finding.distance) >= old->distance - static_cast<double>(finding.allow);
               });
    });
}

// The note that recommends more frames.
std::string more_frames_note(double gap, double length) {
    const double wanted = std::floor(30 * length) + 1;
    const bool is_all = wanted <= static_cast<double>(max_advised);
    const std::size_t frames = is_all ? static_cast<std::size_t>(wanted) : max_advised;
    const std::string interval =
        is_all ? "30 times a second" : fmt::format("every {:.4g} s", length / static_cast<double>(frames - 1));
    return fmt::format(
        "frames are up to {:.4g} s apart, and depths between them are only sampled; --frames {} samples {}", gap,
        frames, interval);
}

template <int D>
std::vector<std::string> notes_of(const File<D>& file, const Objects<D>& objects, const std::vector<double>& times,
                                  bool chose_frames, std::uint64_t left_out_of_baseline) {
    std::vector<std::string> notes = file.warnings;
    if (left_out_of_baseline > 0)
        notes.push_back(fmt::format("the baseline left out {} contacts, which count as new", left_out_of_baseline));
    const std::vector<std::string> hidden = objects.hidden();
    if (!hidden.empty())
        notes.push_back(fmt::format("{} scaled to nothing at some times and left out there, such as '{}'",
                                    hidden.size() == 1 ? "1 object is" : fmt::format("{} objects are", hidden.size()),
                                    hidden.front()));
    const std::vector<std::string> unfollowed = objects.discontinuous();
    if (!unfollowed.empty())
        notes.push_back(fmt::format(
            "{} not swept between frames there, such as '{}'",
            unfollowed.size() == 1
                ? "1 object jumps or changes its shape at some times and is"
                : fmt::format("{} objects jump or change their shape at some times and are", unfollowed.size()),
            unfollowed.front()));
    double gap = 0;
    for (std::size_t i = 1; i < times.size(); ++i) gap = std::max(gap, times[i] - times[i - 1]);
    if (gap > max_frame_time && !chose_frames) notes.push_back(more_frames_note(gap, times.back() - times.front()));
    return notes;
}

// Options of contacts apply to the level's faults too.
FaultOptions fault_options(const CheckRequest& request) {
    FaultOptions options = request.faults;
    options.allow = request.options.limits.allow;
    options.pairs = request.options.pairs;
    return options;
}

template <int D>
Result<ExitCode> run(const CheckRequest& request) {
    Baseline known;
    if (request.baseline) {
        Result<Baseline> read = read_baseline(*request.baseline);
        if (!read) return Problem{read.problem().code, *request.baseline + ": " + read.problem().message};
        known = *std::move(read);
    }
    CheckOptions options = request.options;
    // Findings of the baseline are removed later and don't count towards the limit.
    options.max_findings += known.contacts.size();
    Stopwatch watch;
    const Result<File<D>> file = load<D>(request.scene, request.files);
    if (!file) return file.problem();
    Seconds seconds;
    seconds.read = watch.lap();

    const std::vector<double> times = request.frames ? frame_times(*file, *request.frames) : key_times(*file);
    const auto with_file = [&](const Problem& problem) {
        return Problem{problem.code, request.scene + ": " + problem.message};
    };
    ObjectsOf<D> objects(*file);
    if (const std::optional<Problem> problem = check_patterns<D>(request, objects)) return *problem;
    if (const std::optional<Problem> problem = build<D>(objects, times.front())) return with_file(*problem);
    seconds.build = watch.lap();

    LevelView<D> level = level_view(*file, objects, times.front());
    Result<LevelFaults<D>> faults = find_faults(level, fault_options(request));
    if (!faults) return with_file(faults.problem());
    remove_known(*faults, level, known.report);
    seconds.level = watch.lap();

    Result<CheckResult<D>> result = [&] {
        Progress progress("checking");
        return check<D>(objects, times, options, progress);
    }();
    if (!result) return with_file(result.problem());
    seconds.check = watch.lap();

    const std::size_t known_count = remove_known<D>(result->findings, known.contacts, objects);
    const Report<D> report{objects,
                           times,
                           *std::move(result),
                           notes_of<D>(*file, objects, times, request.frames.has_value(), known.left_out),
                           left_out_of(*file),
                           seconds,
                           request.baseline.has_value(),
                           known_count,
                           std::move(level),
                           *std::move(faults)};
    return print(request.json ? json_report(report) : text_report(report, request.scene),
                 report.result.findings.empty() && report.faults.count() == 0 ? fine : found);
}

}  // namespace

Result<ExitCode> run_check(const CheckRequest& request) {
    return in_dimension_of(request.scene, [&](auto dimension) { return run<dimension()>(request); });
}

}  // namespace abut::tool
