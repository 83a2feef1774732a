#include "check.hpp"

#include "between.hpp"

#include <utility>

namespace abut::tool {
namespace {

template <int D>
class Checker {
public:
    Checker(Objects<D>& objects, const CheckOptions& options)
        : objects_(objects),
          options_(options),
          selection_(objects, options.pairs),
          near_(selection_),
          between_(objects, options.limits, selection_),
          findings_(options.max_findings) {}

    std::optional<Problem> look_at(std::size_t frame);
    std::optional<Problem> go_on(std::size_t frame, double from, double to);
    CheckResult<D> finish(std::size_t frames);

private:
    Objects<D>& objects_;
    const CheckOptions& options_;
    Selection selection_;
    NearPairs<D> near_;
    Between<D> between_;
    Findings<D> findings_;
    std::vector<Aabb<D>> boxes_;
    std::uint64_t tested_ = 0;
};

template <int D>
std::optional<Problem> Checker<D>::look_at(std::size_t frame) {
    boxes_.resize(objects_.size());
    for (std::size_t i = 0; i < objects_.size(); ++i)
        boxes_[i] = objects_[i].present ? grown(objects_[i].box, 0.5f * options_.limits.clearance) : Aabb<D>::empty();
    if (std::optional<Problem> problem = near_.find(boxes_)) return problem;
    for (const Pair& pair : near_.pairs()) {
        const Object<D>&a = objects_[pair.first], &b = objects_[pair.second];
        if (frame > 0 && !a.moved && !b.moved) {
            findings_.go_on(pair, frame);
            continue;
        }
        ++tested_;
        std::optional<Meeting<D>> met = meeting(Standing<D>(a), Standing<D>(b), options_.limits);
        if (met) findings_.add(pair, frame, *std::move(met));
    }
    findings_.end_frame();
    return std::nullopt;
}

// From a frame to the next.
template <int D>
std::optional<Problem> Checker<D>::go_on(std::size_t frame, double from, double to) {
    std::optional<Problem> problem;
    objects_.each_stage(from, to, [&](const Stage<D>& stage) {
        if (!problem) problem = between_.look_at(stage, findings_);
    });
    if (!problem) problem = objects_.go_to(to);
    if (!problem) problem = look_at(frame + 1);
    if (!problem) between_.end(frame, findings_);
    return problem;
}

template <int D>
CheckResult<D> Checker<D>::finish(std::size_t frames) {
    CheckResult<D> result;
    result.findings = findings_.take();
    result.left_out = findings_.left_out();
    result.tested = tested_;
    result.swept = between_.swept();
    result.possible = selection_.count(objects_.size()) * frames;
    return result;
}

}  // namespace

template <int D>
Result<CheckResult<D>> check(Objects<D>& objects, const std::vector<double>& times, const CheckOptions& options,
                             ProgressCall progress) {
    Checker<D> checker(objects, options);
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
        std::optional<Problem> problem =
            frame == 0 ? checker.look_at(0) : checker.go_on(frame - 1, times[frame - 1], times[frame]);
        if (problem) return *std::move(problem);
        progress(frame + 1, times.size());
    }
    return checker.finish(times.size());
}

template Result<CheckResult<2>> check(Objects<2>& objects, const std::vector<double>& times,
                                      const CheckOptions& options, ProgressCall progress);
template Result<CheckResult<3>> check(Objects<3>& objects, const std::vector<double>& times,
                                      const CheckOptions& options, ProgressCall progress);

}  // namespace abut::tool
