#include "between.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut::tool {
namespace {

// A pair that touches and parts more often than this on one stage is followed no farther on it.
constexpr int max_touches = 32;
// While a pair touches it is looked at whenever it has gone so far, of the smaller object's size, at least so often on
// a stage, and first of all after what is allowed.
constexpr double max_step = 0.05, stage_part = 1.0 / 64, min_step = 1e-4;

template <int D>
Motion<D> rest_of(const Motion<D>& motion, double from) {
    const auto left = static_cast<float>(1 - from);
    return {pose_at(motion, static_cast<float>(from)), motion.move * left, motion.turn * left};
}

double angle_of(float turn) {
    return std::abs(static_cast<double>(turn));
}
double angle_of(const Vec3& turn) {
    return static_cast<double>(glm::length(turn));
}

// Holds the object all along the motion. A place of it goes along an arc, which lies no farther off the line between
// its ends than the arc's height, while the whole goes along a straight line.
template <int D>
Aabb<D> swept_box(const Object<D>& object, const Motion<D>& motion) {
    if (motion == Motion<D>{object.pose, {}, {}}) return object.box;
    const Pose<D> end = pose_at(motion, 1.0f);
    const auto box_at = [&](const Pose<D>& pose) {
        return bounds(moved(object.shape, affine(Pose<D>{Vec<D>(0.0f), pose.rotation})));
    };
    const double half = std::min(0.5 * angle_of(motion.turn), 3.2);
    const double height = static_cast<double>(object.reach) * (half < 1.5 ? 1 - std::cos(half) : 2);
    const Aabb<D> turning = grown(merged(box_at(motion.from), box_at(end)), static_cast<float>(1.0001 * height));
    const Vec<D> low = glm::min(motion.from.position, end.position),
                 high = glm::max(motion.from.position, end.position);
    return {low + turning.min, high + turning.max};
}

// Where an object is on its way.
template <int D>
struct OnTheWay {
    Pose<D> pose;
    View<D> placed;
    Aabb<D> box;

    OnTheWay(const Object<D>& object, const Motion<D>& motion, double fraction)
        : pose(pose_at(motion, static_cast<float>(fraction))),
          placed(moved(object.shape, affine(pose))),
          box(bounds(placed)) {}
};

}  // namespace

template <int D>
void Between<D>::found(const Pair& pair, double first, double time, Meeting<D>&& meeting) {
    const auto [place, is_new] = found_.try_emplace(pair);
    Finding<D>& finding = place->second;
    if (is_new) {
        finding.a = pair.first;
        finding.b = pair.second;
        finding.between = true;
        finding.time = first;
    }
    finding.last_time = time;
    if (meeting.distance >= finding.distance) return;
    finding.deepest_time = time;
    finding.distance = meeting.distance;
    finding.allow = meeting.allow;
    finding.normal = meeting.normal;
    finding.points = std::move(meeting.points);
    finding.inside = meeting.inside;
}

template <int D>
void Between<D>::look_at(const Pair& pair, const Stage<D>& stage, float clearance) {
    const Object<D>&a = objects_[pair.first], &b = objects_[pair.second];
    const Motion<D>&motion_a = stage.motions[pair.first], &motion_b = stage.motions[pair.second];
    const double turning = speed(Motion<D>{{}, {}, motion_a.turn}, static_cast<double>(a.reach)) +
                           speed(Motion<D>{{}, {}, motion_b.turn}, static_cast<double>(b.reach));
    const double fastest = speed(Motion<D>{{}, motion_a.move - motion_b.move, {}}, 0) + turning;
    if (!(fastest > 0)) return;
    ++swept_;
    const double size = static_cast<double>(smaller_size(a, b));
    const double first_step = std::max(static_cast<double>(allowed_depth(a, b, limits_)), min_step * size) / fastest;
    const double longest = std::max(max_step * size / fastest, stage_part);
    const auto time_of = [&](double fraction) { return stage.from + (stage.to - stage.from) * fraction; };
    const OnTheWay<D> first_a(a, motion_a, 0), first_b(b, motion_b, 0);
    const Closest<D> gap = closest(first_a.placed, first_b.placed);
    if (static_cast<double>(gap.distance) > 1.001 * (fastest + static_cast<double>(clearance))) return;
    const View<D> rounded_a = clearance > 0 ? rounded(a.shape, static_cast<double>(clearance)) : a.shape;

    double at = 0;
    for (int touch = 0; touch < max_touches && at < 1; ++touch) {
        const std::optional<Hit<D>> hit =
            sweep(rounded_a, rest_of(motion_a, at), b.shape, rest_of(motion_b, at), QueryOptions<D>{});
        if (!hit) return;
        const double first = at = at + (1 - at) * static_cast<double>(hit->fraction);
        for (double step = first_step;; step = std::min(2 * step, longest)) {
            at = std::min(at + step, 1.0);
            const OnTheWay<D> there_a(a, motion_a, at), there_b(b, motion_b, at);
            const Standing<D> stands_a(a, there_a.pose, there_a.placed, there_a.box);
            const Standing<D> stands_b(b, there_b.pose, there_b.placed, there_b.box);
            std::optional<Meeting<D>> met = meeting(stands_a, stands_b, limits_);
            const bool is_apart = !met && !overlaps(there_a.placed, there_b.placed);
            if (met) found(pair, time_of(first), time_of(at), *std::move(met));
            if (is_apart || at >= 1) break;
        }
    }
}

template <int D>
std::optional<Problem> Between<D>::look_at(const Stage<D>& stage, const Findings<D>& at_first) {
    if (std::find(stage.parts.begin(), stage.parts.end(), Part::moves) == stage.parts.end()) return std::nullopt;
    boxes_.resize(objects_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i)
        boxes_[i] = stage.parts[i] == Part::unfollowed
                        ? Aabb<D>::empty()
                        : grown(swept_box(objects_[i], stage.motions[i]), 0.5f * limits_.clearance);
    if (std::optional<Problem> problem = near_.find(boxes_)) return problem;
    for (const Pair& pair : near_.pairs()) {
        const bool moves = stage.parts[pair.first] == Part::moves || stage.parts[pair.second] == Part::moves;
        if (!moves || at_first.has(pair)) continue;
        look_at(pair, stage, 0);
        if (limits_.clearance > 0 && !found_.contains(pair)) look_at(pair, stage, limits_.clearance);
    }
    return std::nullopt;
}

template <int D>
void Between<D>::end(std::size_t first, Findings<D>& findings) {
    for (auto& [pair, finding] : found_) {
        finding.first = finding.last = finding.deepest = first;
        if (!findings.has(pair)) findings.add(std::move(finding));
    }
    found_.clear();
}

template class Between<2>;
template class Between<3>;

}  // namespace abut::tool
