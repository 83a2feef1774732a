#include "tool/check/swept_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut::tool {

using namespace detail;

namespace {

// A pair that touches and separates more often than this on a stage is not followed further.
constexpr int max_touches = 32;
// Sampling steps while a pair is in contact: at most this motion relative to the smaller object's size, and at most
// this fraction of a stage. The first step is the allowed depth, at least `min_step`.
constexpr double max_step = 0.05, max_stage_fraction = 1.0 / 64, min_step = 1e-4;
// The intervals of a stage, as fractions, in which objects are looked for that may come near.
constexpr double min_interval = 1.0 / 32;
// A sweep may hit what is no farther than this, relative to the smaller object's size.
constexpr double touching = 1e-5;

template <int D>
Motion<D> remaining(const Motion<D>& motion, double from) {
    const auto left = static_cast<float>(1 - from);
    return {pose_at(motion, static_cast<float>(from)), motion.move * left, motion.turn * left};
}

double angle_of(float turn) {
    return std::abs(static_cast<double>(turn));
}
double angle_of(const Vec3& turn) {
    return static_cast<double>(glm::length(turn));
}

// Upper bound of the distance that the points of a shape move along a normal by a rotation.
double rotation_along(const Vec2&, float turn, double reach) {
    return angle_of(turn) * reach;
}
double rotation_along(const Vec3& normal, const Vec3& turn, double reach) {
    return static_cast<double>(glm::length(glm::cross(normal, turn))) * reach;
}

// Upper bound of the distance by which the points of a approach those of b along a normal from a to b.
template <int D>
double closing(const Vec<D>& normal, const Object<D>& a, const Motion<D>& motion_a, const Object<D>& b,
               const Motion<D>& motion_b) {
    return std::max(0.0, static_cast<double>(glm::dot(normal, motion_a.move - motion_b.move))) +
           rotation_along(normal, motion_a.turn, static_cast<double>(a.reach)) +
           rotation_along(normal, motion_b.turn, static_cast<double>(b.reach));
}

// A box that contains the object during the entire motion. A point's path deviates from the straight motion by at most
// the sagitta of its arc.
template <int D>
Aabb<D> swept_box(const Object<D>& object, const Motion<D>& motion) {
    if (motion == Motion<D>{object.pose, {}, {}}) return object.box;
    const Pose<D> end = pose_at(motion, 1.0f);
    const auto box_at = [&](const Pose<D>& pose) {
        return bounds(moved(object.shape, affine(Pose<D>{Vec<D>(0.0f), pose.rotation})));
    };
    const double half = std::min(0.5 * angle_of(motion.turn), 3.2);
    const double height = static_cast<double>(object.reach) * (half < 1.5 ? 1 - std::cos(half) : 2);
    const Aabb<D> rotation = grown(merged(box_at(motion.from), box_at(end)), static_cast<float>(1.0001 * height));
    const Vec<D> low = glm::min(motion.from.position, end.position),
                 high = glm::max(motion.from.position, end.position);
    return {low + rotation.min, high + rotation.max};
}

// An object at a fraction of a motion.
template <int D>
struct PosedObject {
    Pose<D> pose;
    View<D> placed;
    Aabb<D> box;

    PosedObject(const Object<D>& object, const Motion<D>& motion, double fraction)
        : pose(pose_at(motion, static_cast<float>(fraction))),
          placed(moved(object.shape, affine(pose))),
          box(bounds(placed)) {}
};

// Whether two objects may come as near as a clearance between two fractions of their motions: they are as far from each
// other as in the middle between these, but for their motion from there.
template <int D>
bool may_come_near(const Object<D>& a, const Motion<D>& motion_a, const Object<D>& b, const Motion<D>& motion_b,
                   double max_motion, float clearance, double from = 0, double to = 1) {
    const double middle = 0.5 * (from + to);
    const PosedObject<D> posed_a(a, motion_a, middle), posed_b(b, motion_b, middle);
    const double reach = 1.001 * (0.5 * (to - from) * max_motion + static_cast<double>(clearance));
    if (!overlaps(rounded(posed_a.placed, reach), posed_b.placed)) return false;
    const auto may = [&](double first, double last) {
        return may_come_near(a, motion_a, b, motion_b, max_motion, clearance, first, last);
    };
    return to - from <= min_interval || may(from, middle) || may(middle, to);
}

// Extends a contact that began at `first` to a later time.
template <int D>
void extend(std::optional<ContactFinding<D>>& known, double first, double time, PairContact<D>&& contact) {
    if (!known) {
        known.emplace();
        known->between = true;
        known->time = first;
    }
    known->last_time = time;
    if (contact.distance >= known->distance) return;
    known->deepest_time = time;
    known->distance = contact.distance;
    known->allow = contact.allow;
    known->normal = contact.normal;
    known->points = std::move(contact.points);
    known->inside = contact.inside;
}

}  // namespace

template <int D>
void SweptPairs<D>::sweep_pair(const Stage<D>& stage, float clearance, Swept& swept) const {
    const Pair& pair = swept.pair;
    const Object<D>&a = *swept.a, &b = *swept.b;
    const Motion<D>&motion_a = stage.motions[pair.first], &motion_b = stage.motions[pair.second];
    const double rotation = speed(Motion<D>{{}, {}, motion_a.turn}, static_cast<double>(a.reach)) +
                            speed(Motion<D>{{}, {}, motion_b.turn}, static_cast<double>(b.reach));
    const double max_motion = speed(Motion<D>{{}, motion_a.move - motion_b.move, {}}, 0) + rotation;
    if (!(max_motion > 0)) return;
    swept.is_swept = true;
    const double size = static_cast<double>(smaller_size(a, b));
    const double first_step = std::max(static_cast<double>(allowed_depth(a, b, limits_)), min_step * size) / max_motion;
    const double longest = std::max(max_step * size / max_motion, max_stage_fraction);
    const auto time_of = [&](double fraction) { return stage.from + (stage.to - stage.from) * fraction; };
    if (!may_come_near(a, motion_a, b, motion_b, max_motion, clearance)) return;
    // Two bodies on either side of a plane come no closer than by their motion through it.
    if (a.solid && b.solid) {
        const PosedObject<D> first_a(a, motion_a, 0), first_b(b, motion_b, 0);
        const Closest<D> gap = closest(first_a.placed, first_b.placed);
        const double least = static_cast<double>(gap.distance) - 1.001 * closing(gap.normal, a, motion_a, b, motion_b);
        const double ignored = limits_.clearance > 0 ? static_cast<double>(limits_.clearance) + touching * size
                                                     : -0.999 * static_cast<double>(allowed_depth(a, b, limits_));
        if (least > ignored) return;
    }
    const View<D> rounded_a = clearance > 0 ? rounded(a.shape, static_cast<double>(clearance)) : a.shape;

    double fraction = 0;
    for (int touch = 0; touch < max_touches && fraction < 1; ++touch) {
        const std::optional<Hit<D>> hit =
            sweep(rounded_a, remaining(motion_a, fraction), b.shape, remaining(motion_b, fraction), QueryOptions<D>{});
        if (!hit) return;
        const double first = fraction = fraction + (1 - fraction) * static_cast<double>(hit->fraction);
        for (double step = first_step;; step = std::min(2 * step, longest)) {
            fraction = std::min(fraction + step, 1.0);
            const PosedObject<D> posed_a(a, motion_a, fraction), posed_b(b, motion_b, fraction);
            const ObjectAt<D> object_a(a, posed_a.pose, posed_a.placed, posed_a.box);
            const ObjectAt<D> object_b(b, posed_b.pose, posed_b.placed, posed_b.box);
            std::optional<PairContact<D>> contact = pair_contact(object_a, object_b, limits_);
            const bool is_separate = !contact && !overlaps(posed_a.placed, posed_b.placed);
            if (contact) extend(swept.contact, time_of(first), time_of(fraction), *std::move(contact));
            if (is_separate || fraction >= 1) break;
        }
    }
}

template <int D>
std::optional<Problem> SweptPairs<D>::add(const Stage<D>& stage, const ContactFindings<D>& at_first) {
    if (std::find(stage.parts.begin(), stage.parts.end(), StageMotion::moves) == stage.parts.end()) return std::nullopt;
    boxes_.resize(objects_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i)
        boxes_[i] = stage.parts[i] == StageMotion::discontinuous
                        ? Aabb<D>::empty()
                        : grown(swept_box(objects_[i], stage.motions[i]), 0.5f * limits_.clearance);
    if (std::optional<Problem> problem = overlapping_.find(boxes_, piles_)) return problem;
    std::vector<Swept>& pairs = stages_.emplace_back(SweptStage{stage, {}}).pairs;
    for (const Pair& pair : overlapping_.pairs()) {
        const bool moves =
            stage.parts[pair.first] == StageMotion::moves || stage.parts[pair.second] == StageMotion::moves;
        if (moves && !at_first.has(pair)) pairs.push_back({pair, copies_.of(pair.first), copies_.of(pair.second)});
    }
    return std::nullopt;
}

template <int D>
void SweptPairs<D>::add(Swept&& swept) {
    swept_ += swept.is_swept ? 1 : 0;
    if (!swept.contact) return;
    ContactFinding<D>& contact = *swept.contact;
    contact.a = swept.pair.first;
    contact.b = swept.pair.second;
    const auto [entry, is_new] = contacts_.try_emplace(swept.pair);
    ContactFinding<D>& known = entry->second;
    const double first = is_new ? contact.time : known.time, last = contact.last_time;
    if (is_new || contact.distance < known.distance) known = std::move(contact);
    known.time = first;
    known.last_time = last;
}

template <int D>
void SweptPairs<D>::find(std::size_t first, ContactFindings<D>& findings) {
    for (SweptStage& of_stage : stages_) {
        const Stage<D>& stage = of_stage.stage;
        std::vector<Swept>& pairs = of_stage.pairs;
        std::erase_if(pairs, [&](const Swept& swept) { return findings.has(swept.pair); });
        workers_.run(static_cast<std::uint32_t>(pairs.size()), [&](std::uint32_t i) {
            Swept& swept = pairs[i];
            sweep_pair(stage, 0, swept);
            if (limits_.clearance > 0 && !swept.contact && !contacts_.contains(swept.pair))
                sweep_pair(stage, limits_.clearance, swept);
        });
        for (Swept& swept : pairs) add(std::move(swept));
    }
    stages_.clear();
    for (auto& [pair, finding] : contacts_) {
        finding.first = finding.last = finding.deepest = first;
        findings.add(std::move(finding));
    }
    contacts_.clear();
}

template class SweptPairs<2>;
template class SweptPairs<3>;

}  // namespace abut::tool
