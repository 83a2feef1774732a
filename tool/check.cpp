#include "check.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace abut::tool {
namespace {

// Of the smaller object's size: what things that stand on things may sink in.
constexpr float default_allow = 1e-3f;
// Of the smaller object's size: the margin of every answer, within which a gap is none.
constexpr float margin = 1e-5f;

// How one pair stands at one moment, if that is to be reported.
template <int D>
struct Meeting {
    float distance = 0;
    float allow = 0;
    Vec<D> normal{};
    std::vector<Vec<D>> points;
    bool inside = false;
};

// Whether a point from inside of one body is inside of the other, a mesh that is filled. What the point is under of
// both surfaces together is how far they must move to come apart by the shortest way there: at least, and exact for
// balls and for things placed twice.
template <int D>
std::optional<Meeting<D>> inside(const Object<D>& outer, const Object<D>& inner, float allow) {
    if (!outer.filled) return std::nullopt;
    const Vec<D> point = inner.pose * inner.inside.point;
    if (!contains(outer.box, point) || !contains(outer.placed, point)) return std::nullopt;
    const Closest<D> way_out = closest(outer.placed, point);
    const float depth = way_out.distance + inner.inside.depth;
    if (!(depth > allow)) return std::nullopt;
    // From the nearest place of the surface to the point: the way in.
    return Meeting<D>{-depth, allow, -way_out.normal, {point}, true};
}

template <int D>
class Checker {
public:
    Checker(Objects<D>& objects, const CheckOptions& options)
        : objects_(objects), options_(options), selection_(objects, options.pairs) {}

    void look_at(std::size_t frame);
    CheckResult<D> finish(std::size_t frames);

private:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    std::optional<Meeting<D>> meeting(const Object<D>& a, const Object<D>& b) const;
    void go_on(const Pair& pair, std::size_t frame);
    void found(const Pair& pair, std::size_t frame, Meeting<D>&& meeting);
    void close_all_but(std::size_t frame);

    Objects<D>& objects_;
    const CheckOptions& options_;
    Selection selection_;
    Bvh<D> tree_;
    std::vector<Aabb<D>> boxes_;
    std::vector<Pair> near_;
    std::map<Pair, Finding<D>> open_;  // what was there at the frame before
    CheckResult<D> result_;
};

template <int D>
std::optional<Meeting<D>> Checker<D>::meeting(const Object<D>& a, const Object<D>& b) const {
    const float smaller = std::min(a.radius, b.radius);
    const float allow = options_.allow.value_or(default_allow * smaller);
    const bool wants_gaps = options_.clearance > 0;
    if (wants_gaps || overlaps(a.placed, b.placed)) {
        const Contact<D> c = contact(a.placed, b.placed, {.margin = options_.clearance});
        const bool collides = c && c.depth > allow;
        const bool too_near = c && wants_gaps && (c.depth < -margin * smaller) && (c.depth > -options_.clearance);
        if (collides || too_near) {
            Meeting<D> result{-c.depth, allow, c.normal, {}, false};
            for (const auto& point : c.points) result.points.push_back(point.position);
            return result;
        }
    }
    if (std::optional<Meeting<D>> result = inside(a, b, allow)) return result;
    std::optional<Meeting<D>> result = inside(b, a, allow);
    if (result) result->normal = -result->normal;
    return result;
}

template <int D>
void Checker<D>::go_on(const Pair& pair, std::size_t frame) {
    const auto open = open_.find(pair);
    if (open != open_.end()) open->second.last = frame;
}

template <int D>
void Checker<D>::found(const Pair& pair, std::size_t frame, Meeting<D>&& meeting) {
    const auto [open, is_new] = open_.try_emplace(pair);
    Finding<D>& finding = open->second;
    if (is_new) {
        finding.a = pair.first;
        finding.b = pair.second;
        finding.first = frame;
    }
    finding.last = frame;
    if (!is_new && meeting.distance >= finding.distance) return;
    finding.deepest = frame;
    finding.distance = meeting.distance;
    finding.allow = meeting.allow;
    finding.normal = meeting.normal;
    finding.points = std::move(meeting.points);
    finding.inside = meeting.inside;
}

template <int D>
void Checker<D>::close_all_but(std::size_t frame) {
    for (auto open = open_.begin(); open != open_.end();) {
        if (open->second.last == frame) {
            ++open;
            continue;
        }
        result_.findings.push_back(std::move(open->second));
        open = open_.erase(open);
    }
}

template <int D>
void Checker<D>::look_at(std::size_t frame) {
    boxes_.resize(objects_.size());
    for (std::size_t i = 0; i < objects_.size(); ++i)
        boxes_[i] = objects_[i].present ? grown(objects_[i].box, 0.5f * options_.clearance) : Aabb<D>::empty();
    if (frame == 0)
        tree_.build(boxes_);
    else
        tree_.update(boxes_);
    tree_.sorted_pairs(near_);
    for (const Pair& pair : near_) {
        const Object<D>& a = objects_[pair.first];
        const Object<D>& b = objects_[pair.second];
        if (!selection_.has(pair.first, pair.second)) continue;
        if (frame > 0 && !a.moved && !b.moved) {
            go_on(pair, frame);
            continue;
        }
        ++result_.tested;
        if (std::optional<Meeting<D>> met = meeting(a, b)) found(pair, frame, *std::move(met));
    }
    close_all_but(frame);
}

template <int D>
CheckResult<D> Checker<D>::finish(std::size_t frames) {
    close_all_but(frames);
    std::sort(result_.findings.begin(), result_.findings.end(), [](const Finding<D>& a, const Finding<D>& b) {
        return std::tie(a.a, a.b, a.first) < std::tie(b.a, b.b, b.first);
    });
    result_.possible = selection_.count(objects_.size()) * frames;
    return std::move(result_);
}

}  // namespace

template <int D>
Result<CheckResult<D>> check(Objects<D>& objects, const std::vector<double>& times, const CheckOptions& options,
                             ProgressCall progress) {
    Checker<D> checker(objects, options);
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
        if (frame > 0)
            if (std::optional<Problem> problem = objects.go_to(times[frame])) return *std::move(problem);
        checker.look_at(frame);
        progress(frame + 1, times.size());
    }
    return checker.finish(times.size());
}

template Result<CheckResult<2>> check(Objects<2>& objects, const std::vector<double>& times,
                                      const CheckOptions& options, ProgressCall progress);
template Result<CheckResult<3>> check(Objects<3>& objects, const std::vector<double>& times,
                                      const CheckOptions& options, ProgressCall progress);

}  // namespace abut::tool
