#include "tool/check/check.hpp"

#include "tool/check/deepest_frames.hpp"
#include "tool/check/swept_pairs.hpp"
#include <abut/math/thread_pool.hpp>

#include <optional>
#include <utility>

namespace abut::tool {
namespace {

template <int D>
class Checker {
public:
    Checker(Objects<D>& objects, const CheckOptions& options, std::size_t frames)
        : objects_(objects),
          options_(options),
          filter_(objects, options.pairs, options.bodies),
          workers_(static_cast<std::uint32_t>(options.threads)),
          piles_(objects, options.limits, filter_),
          overlapping_(filter_),
          copies_(objects),
          swept_pairs_(objects, copies_, options.limits, filter_, piles_, workers_),
          findings_(options.max_findings) {
        if constexpr (D == 3)
            if (frames > 1) deepest_.emplace(objects, copies_, options.limits, workers_);
    }

    std::optional<Problem> test(std::size_t frame);
    std::optional<Problem> advance(std::size_t frame, double from, double to);
    CheckResult<D> finish(std::size_t frames);

private:
    bool rests(const Pair& pair, std::size_t frame) const {
        return frame > 0 && !objects_[pair.first].moved && !objects_[pair.second].moved;
    }
    void find_depths(std::size_t frame);

    Objects<D>& objects_;
    const CheckOptions& options_;
    PairFilter filter_;
    ThreadPool workers_;
    Piles<D> piles_;
    OverlappingPairs<D> overlapping_;
    ObjectCopies<D> copies_;
    SweptPairs<D> swept_pairs_;
    ContactFindings<D> findings_;
    std::vector<Aabb<D>> boxes_;
    std::vector<std::optional<PairContact<D>>> contacts_;  // per pair of the frame
    std::optional<DeepestFrames> deepest_;                 // of bodies that move
    std::vector<Pair> in_contact_;
    std::uint64_t tested_ = 0;
};

template <int D>
std::optional<Problem> Checker<D>::test(std::size_t frame) {
    boxes_.resize(objects_.size());
    for (std::size_t i = 0; i < objects_.size(); ++i)
        boxes_[i] = objects_[i].present ? grown(objects_[i].box, 0.5f * options_.limits.clearance) : Aabb<D>::empty();
    if (std::optional<Problem> problem = overlapping_.find(boxes_, piles_, [&] { piles_.find(boxes_, frame); }))
        return problem;
    const std::vector<Pair>& pairs = overlapping_.pairs();
    const Depth depth = deepest_ ? Depth::not_needed : Depth::needed;
    contacts_.clear();
    contacts_.resize(pairs.size());
    workers_.run(static_cast<std::uint32_t>(pairs.size()), [&](std::uint32_t i) {
        if (rests(pairs[i], frame)) return;
        contacts_[i] = pair_contact(ObjectAt<D>(objects_[pairs[i].first]), ObjectAt<D>(objects_[pairs[i].second]),
                                    options_.limits, depth);
    });
    find_depths(frame);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (rests(pairs[i], frame)) {
            findings_.extend(pairs[i], frame);
            continue;
        }
        ++tested_;
        if (!contacts_[i]) continue;
        if (contacts_[i]->has_depth) {
            findings_.add(pairs[i], frame, *std::move(contacts_[i]));
            continue;
        }
        findings_.add(pairs[i], frame);
        if constexpr (D == 3) deepest_->add(pairs[i], frame);
    }
    findings_.end_frame();
    return std::nullopt;
}

// Finds the depths of pairs that were in contact until this frame.
template <int D>
void Checker<D>::find_depths(std::size_t frame) {
    if constexpr (D == 3) {
        if (!deepest_) return;
        in_contact_.clear();
        for (std::size_t i = 0; i < contacts_.size(); ++i)
            if (const Pair& pair = overlapping_.pairs()[i]; contacts_[i] || rests(pair, frame))
                in_contact_.push_back(pair);
        deepest_->find(in_contact_, findings_);
    }
}

// Sweeps from a frame to the next one and tests that frame.
template <int D>
std::optional<Problem> Checker<D>::advance(std::size_t frame, double from, double to) {
    std::optional<Problem> problem;
    objects_.each_stage(from, to, [&](const Stage<D>& stage) {
        if (!problem) problem = swept_pairs_.add(stage, findings_);
    });
    if (!problem) problem = objects_.go_to(to);
    if (!problem) problem = test(frame + 1);
    if (!problem) swept_pairs_.find(frame, findings_);
    return problem;
}

template <int D>
CheckResult<D> Checker<D>::finish(std::size_t frames) {
    CheckResult<D> result;
    if constexpr (D == 3)
        if (deepest_) deepest_->find({}, findings_);
    result.findings = findings_.take();
    result.piles = piles_.all();
    result.left_out = findings_.left_out();
    result.tested = tested_;
    result.swept = swept_pairs_.swept();
    result.possible = filter_.count(objects_.size()) * frames;
    return result;
}

}  // namespace

template <int D>
Result<CheckResult<D>> check(Objects<D>& objects, const std::vector<double>& times, const CheckOptions& options,
                             ProgressCall progress) {
    Checker<D> checker(objects, options, times.size());
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
        std::optional<Problem> problem =
            frame == 0 ? checker.test(0) : checker.advance(frame - 1, times[frame - 1], times[frame]);
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
