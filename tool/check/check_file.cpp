#include "tool/check/check_file.hpp"

#include "tool/check/baseline.hpp"
#include "tool/check/contact_report.hpp"
#include "tool/check/selection.hpp"
#include "tool/faults/fault_report.hpp"
#include "tool/objects/bodies.hpp"
#include "tool/objects/solid_objects.hpp"
#include "tool/page/documents.hpp"
#include "tool/shared/left_out.hpp"
#include "tool/shared/printable.hpp"
#include "tool/shared/progress.hpp"
#include "tool/shared/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace abut::tool {
namespace {

// Seconds between frames above which more frames are recommended.
constexpr double max_frame_time = 0.25;
// Limit of the number of frames recommended.
constexpr std::size_t max_advised = 100'000;

// The name of objects that aren't convex solids.
template <int D>
constexpr const char* not_solids = D == 2 ? "composites" : "meshes";

// A pattern that matches nothing is an error: the check could never fail.
template <int D>
std::optional<Problem> check_patterns(const CheckPlan& plan, const Objects<D>& objects) {
    const auto missing = [&](const char* option, const std::string& pattern) -> std::optional<Problem> {
        for (std::size_t i = 0; i < objects.size(); ++i)
            if (matches_name(pattern, objects[i])) return std::nullopt;
        return Problem{ProblemCode::bad_argument, fmt::format("{}: no object is named '{}'", option, pattern)};
    };
    for (const PairPattern& pattern : plan.contacts.pairs)
        for (const std::string& side : {pattern.a, pattern.b})
            if (std::optional<Problem> problem = missing("--pairs", side)) return problem;
    return std::nullopt;
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

std::string such_as(const std::vector<std::string>& paths, const char* one, const char* many, const char* what) {
    return fmt::format("{} {}, such as '{}'", paths.size() == 1 ? one : fmt::format("{} {}", paths.size(), many), what,
                       paths.front());
}

template <int D>
void add_notes(FileReport& report, const Objects<D>& objects, const std::vector<double>& times, bool chose_frames) {
    if (const std::vector<std::string> hidden = objects.hidden(); !hidden.empty())
        report.notes.push_back(
            such_as(hidden, "1 object is", "objects are", "scaled to nothing at some times and left out there"));
    if (const std::vector<std::string> unfollowed = objects.discontinuous(); !unfollowed.empty())
        report.notes.push_back(such_as(unfollowed, "1 object jumps or changes its shape at some times and is",
                                       "objects jump or change their shape at some times and are",
                                       "not swept between frames there"));
    double gap = 0;
    for (std::size_t i = 1; i < times.size(); ++i) gap = std::max(gap, times[i] - times[i - 1]);
    if (gap > max_frame_time && !chose_frames)
        report.notes.push_back(more_frames_note(gap, times.back() - times.front()));
}

// All of a scene collides; of a level, what solid_objects.hpp says.
Result<SolidObjects> solids_in(const Scene&, const CheckPlan& plan) {
    if (plan.solid.empty()) return SolidObjects();
    return Problem{ProblemCode::bad_argument, "--solid: all objects of a 3D scene collide"};
}
Result<SolidObjects> solids_in(const Level& level, const CheckPlan& plan) {
    return solid_objects(level, plan.solid);
}

SceneObjects objects_in(const Scene& scene, const SolidObjects&) {
    return SceneObjects(scene);
}
LevelObjects objects_in(const Level& level, const SolidObjects& solid) {
    return LevelObjects(level, solid.solid);
}

Result<std::vector<std::uint32_t>> bodies_in(const Scene& scene, const SceneObjects& objects, const SolidObjects&,
                                             const CheckPlan& plan) {
    return bodies_of(scene, objects, plan.bodies);
}
Result<std::vector<std::uint32_t>> bodies_in(const Level& level, const LevelObjects& objects, const SolidObjects& solid,
                                             const CheckPlan& plan) {
    return bodies_of(level, objects, solid.ground, plan.bodies);
}

struct Seconds {
    double read = 0, build = 0, check = 0, level = 0;
};

template <int D>
class FileCheck {
public:
    FileCheck(const std::string& file, const CheckPlan& plan, std::size_t threads)
        : file_(file), plan_(plan), threads_(threads) {}

    Result<FileReport> run();

private:
    std::optional<Problem> find(FileReport& report, Objects<D>& objects, const std::vector<double>& times,
                                const LevelView<D>& level, std::vector<std::uint32_t> bodies);
    void summarise(FileReport& report, const Objects<D>& objects, const std::vector<double>& times,
                   const std::vector<LeftOutOf>& left_out) const;
    bool checks(const RuleInfo& rule) const {
        return plan_.severities.of(rule.rule) != Severity::off && (rule.kind != Kind::gap || faults_.gap_range);
    }

    const std::string& file_;
    const CheckPlan& plan_;
    std::size_t threads_;
    Baseline baseline_;
    CheckResult<D> contacts_;
    LevelFaults<D> faults_;
    Seconds seconds_;
    Stopwatch watch_;
};

template <int D>
std::optional<Problem> FileCheck<D>::find(FileReport& report, Objects<D>& objects, const std::vector<double>& times,
                                          const LevelView<D>& level, std::vector<std::uint32_t> bodies) {
    Result<LevelFaults<D>> faults = find_faults(level, plan_.faults, plan_.severities);
    if (!faults) return faults.problem();
    faults_ = *std::move(faults);
    report.findings = findings_of(faults_, level, plan_.severities);
    report.notes.insert(report.notes.end(), faults_.notes.begin(), faults_.notes.end());
    seconds_.level = watch_.lap();
    if (plan_.severities.checks(Kind::contact) || plan_.severities.checks(Kind::inside)) {
        CheckOptions options = plan_.contacts;
        // Findings of the baseline are removed later and don't count towards the limit.
        options.max_findings += baseline_.contacts;
        options.threads = threads_;
        options.bodies = std::move(bodies);
        Progress progress("checking");
        Result<CheckResult<D>> contacts = check<D>(objects, times, options, progress);
        if (!contacts) return contacts.problem();
        contacts_ = *std::move(contacts);
        std::vector<Finding> found = findings_of(contacts_, objects, times, plan_.severities);
        std::move(found.begin(), found.end(), std::back_inserter(report.findings));
    }
    seconds_.check = watch_.lap();
    return std::nullopt;
}

template <int D>
Result<FileReport> FileCheck<D>::run() {
    const auto with_file = [&](const Problem& problem) {
        return Problem{problem.code, file_ + ": " + problem.message};
    };
    if (plan_.baseline) {
        Result<Baseline> read = read_baseline(*plan_.baseline, file_);
        if (!read) return Problem{read.problem().code, *plan_.baseline + ": " + read.problem().message};
        baseline_ = *std::move(read);
    }
    watch_.lap();
    const Result<File<D>> file = load<D>(file_, plan_.files);
    if (!file) return file.problem();
    seconds_.read = watch_.lap();
    const std::vector<double> times = plan_.frames ? frame_times(*file, *plan_.frames) : key_times(*file);
    const Result<SolidObjects> solid = solids_in(*file, plan_);
    if (!solid) return with_file(solid.problem());
    ObjectsOf<D> objects = objects_in(*file, *solid);
    const Result<std::vector<std::uint32_t>> bodies = bodies_in(*file, objects, *solid, plan_);
    if (!bodies) return with_file(bodies.problem());
    if (const std::optional<Problem> problem = check_patterns<D>(plan_, objects)) return with_file(*problem);
    if (const std::optional<Problem> problem = build<D>(objects, times.front())) return with_file(*problem);
    seconds_.build = watch_.lap();

    FileReport report;
    report.file = printable(file_);
    report.dimension = D;
    report.units = units_of(file_);
    report.notes = file->warnings;
    if (!solid->note.empty()) report.notes.push_back(solid->note);
    const LevelView<D> level = level_view(*file, objects, times.front());
    if (level.problem) return with_file(*level.problem);
    if (const std::optional<Problem> problem = find(report, objects, times, level, *bodies)) return with_file(*problem);
    remove_ignored(report, plan_.ignored);
    if (plan_.baseline) {
        std::set<std::string> paths;
        for (std::size_t i = 0; i < objects.size(); ++i) paths.insert(objects[i].path);
        for (const NamedPlace<D>& place : level.places) paths.insert(place.path);
        compare(
            report, baseline_, [&](const RuleInfo& rule) { return checks(rule); },
            [&](const std::string& path) { return paths.contains(path); });
        if (baseline_.left_out > 0)
            report.notes.push_back(
                fmt::format("the baseline left out {} contacts, which count as new", baseline_.left_out));
    }
    if (plan_.warnings_as_errors)
        for (Finding& finding : report.findings) finding.severity = Severity::error;
    sort_findings(report.findings);
    add_notes<D>(report, objects, times, plan_.frames.has_value());
    summarise(report, objects, times, left_out_of(*file));
    add_documents(report, plan_, *file, objects, times, level);
    return report;
}

template <int D>
void FileCheck<D>::summarise(FileReport& report, const Objects<D>& objects, const std::vector<double>& times,
                             const std::vector<LeftOutOf>& left_out) const {
    const std::size_t solids = objects.count_solids();
    report.details = {
        {"objects", objects.size()},
        {"solids", solids},
        {not_solids<D>, objects.size() - solids},
        {"frames", times.size()},
        {"pairs", contacts_.tested},
        {"possible_pairs", contacts_.possible},
        {"swept_pairs", contacts_.swept},
        {"contacts_left_out", contacts_.left_out},
        {"spawn_points", faults_.spawns_tested},
        {"left_out", json_of(left_out)},
        {"seconds",
         {{"read", seconds_.read}, {"build", seconds_.build}, {"check", seconds_.check}, {"level", seconds_.level}}}};

    std::string& text = report.summary;
    text = fmt::format("objects   {}: {} taken as convex solids, {} as {}\n", objects.size(), solids,
                       objects.size() - solids, not_solids<D>);
    if (!left_out.empty()) text += "left out  " + text_of(left_out) + "\n";
    text += fmt::format("frames    {}", times.size());
    if (times.size() > 1) text += fmt::format(", from {} s to {} s", number(times.front()), number(times.back()));
    const double share = contacts_.possible == 0
                             ? 0
                             : 100.0 * static_cast<double>(contacts_.tested) / static_cast<double>(contacts_.possible);
    text +=
        fmt::format("\npairs     {} tested of {} possible ({} %)", contacts_.tested, contacts_.possible, number(share));
    if (contacts_.swept > 0) text += fmt::format(", {} swept between frames", contacts_.swept);
    if (contacts_.left_out > 0) text += fmt::format("\ncontacts  {} more, no deeper, are left out", contacts_.left_out);
    if (faults_.spawns_tested > 0)
        text +=
            fmt::format("\nspawns    {} of {} blocked or out of place", faults_.spawns.size(), faults_.spawns_tested);
    if (faults_.gap_range)
        text += fmt::format("\ngaps      {} from {} to {} wide", faults_.gaps.size(),
                            number(static_cast<double>(faults_.gap_range->min_width)),
                            number(static_cast<double>(faults_.gap_range->width)));
    if (report.ignored > 0) text += "\nignored   " + counted(report.ignored, "finding", "findings");
    if (report.has_baseline)
        text += fmt::format("\nbaseline  has {} that are still there, {} that are mended, {} of objects that are gone",
                            report.known, report.mended.size(), report.stale.size());
    text += fmt::format("\nseconds   read {:.3f}, build {:.3f}, check {:.3f}, level {:.3f}\n", seconds_.read,
                        seconds_.build, seconds_.check, seconds_.level);
}

}  // namespace

Result<FileReport> check_file(const std::string& file, const CheckPlan& plan, std::size_t threads) {
    return in_dimension_of(file, [&](auto dimension) { return FileCheck<dimension()>(file, plan, threads).run(); });
}

}  // namespace abut::tool
