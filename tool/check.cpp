#include "check.hpp"

#include "glob.hpp"

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
struct Meeting {
    float distance = 0;
    float allow = 0;
    Vec3 normal{};
    std::vector<Vec3> points;
    bool inside = false;
};

// The pairs that the patterns describe.
class Selection {
public:
    Selection(const Objects& objects, const std::vector<PairPattern>& patterns) {
        for (const PairPattern& pattern : patterns) {
            Sides sides;
            for (std::size_t i = 0; i < objects.size(); ++i) {
                sides.a.push_back(describes(pattern.a, objects[i]));
                sides.b.push_back(describes(pattern.b, objects[i]));
            }
            sides_.push_back(std::move(sides));
        }
    }

    bool has(std::size_t i, std::size_t j) const {
        return sides_.empty() || std::any_of(sides_.begin(), sides_.end(),
                                             [&](const Sides& s) { return (s.a[i] && s.b[j]) || (s.a[j] && s.b[i]); });
    }
    std::uint64_t count(std::size_t objects) const {
        std::uint64_t result = objects < 2 ? 0 : std::uint64_t{objects} * (objects - 1) / 2;
        if (sides_.empty()) return result;
        result = 0;
        for (std::size_t i = 0; i < objects; ++i)
            for (std::size_t j = i + 1; j < objects; ++j) result += has(i, j) ? 1 : 0;
        return result;
    }

private:
    struct Sides {
        std::vector<bool> a, b;
    };
    std::vector<Sides> sides_;
};

// Whether a point from inside of one body is inside of the other, a mesh that is filled. What the point is under of
// both surfaces together is how far they must move to come apart by the shortest way there: at least, and exact for
// balls and for things placed twice.
std::optional<Meeting> inside(const Object& outer, const Object& inner, float allow) {
    if (!outer.filled) return std::nullopt;
    const Vec3 point = inner.pose * inner.inside.point;
    if (!contains(outer.box, point) || !contains(outer.placed, point)) return std::nullopt;
    const Closest<3> way_out = closest(outer.placed, point);
    const float depth = way_out.distance + inner.inside.depth;
    if (!(depth > allow)) return std::nullopt;
    // From the nearest place of the surface to the point: the way in.
    return Meeting{-depth, allow, -way_out.normal, {point}, true};
}

class Checker {
public:
    Checker(Objects& objects, const CheckOptions& options)
        : objects_(objects), options_(options), selection_(objects, options.pairs) {}

    void look_at(std::size_t frame);
    CheckResult finish(std::size_t frames);

private:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    std::optional<Meeting> meeting(const Object& a, const Object& b) const;
    void go_on(const Pair& pair, std::size_t frame);
    void found(const Pair& pair, std::size_t frame, Meeting&& meeting);
    void close_all_but(std::size_t frame);

    Objects& objects_;
    const CheckOptions& options_;
    Selection selection_;
    Bvh<3> tree_;
    std::vector<Aabb3> boxes_;
    std::vector<Pair> near_;
    std::map<Pair, Finding> open_;  // what was there at the frame before
    CheckResult result_;
};

std::optional<Meeting> Checker::meeting(const Object& a, const Object& b) const {
    const float smaller = std::min(a.radius, b.radius);
    const float allow = options_.allow.value_or(default_allow * smaller);
    const bool wants_gaps = options_.clearance > 0;
    if (wants_gaps || overlaps(a.placed, b.placed)) {
        const Contact<3> c = contact(a.placed, b.placed, {.margin = options_.clearance});
        const bool collides = c && c.depth > allow;
        const bool too_near = c && wants_gaps && c.depth < -margin * smaller && c.depth > -options_.clearance;
        if (collides || too_near) {
            Meeting result{-c.depth, allow, c.normal, {}, false};
            for (const auto& point : c.points) result.points.push_back(point.position);
            return result;
        }
    }
    if (std::optional<Meeting> result = inside(a, b, allow)) return result;
    std::optional<Meeting> result = inside(b, a, allow);
    if (result) result->normal = -result->normal;
    return result;
}

void Checker::go_on(const Pair& pair, std::size_t frame) {
    const auto open = open_.find(pair);
    if (open != open_.end()) open->second.last = frame;
}

void Checker::found(const Pair& pair, std::size_t frame, Meeting&& meeting) {
    const auto [open, is_new] = open_.try_emplace(pair);
    Finding& finding = open->second;
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

void Checker::close_all_but(std::size_t frame) {
    for (auto open = open_.begin(); open != open_.end();) {
        if (open->second.last == frame) {
            ++open;
            continue;
        }
        result_.findings.push_back(std::move(open->second));
        open = open_.erase(open);
    }
}

void Checker::look_at(std::size_t frame) {
    boxes_.resize(objects_.size());
    for (std::size_t i = 0; i < objects_.size(); ++i)
        boxes_[i] = objects_[i].present ? grown(objects_[i].box, 0.5f * options_.clearance) : Aabb3::empty();
    if (frame == 0)
        tree_.build(boxes_);
    else
        tree_.update(boxes_);
    tree_.sorted_pairs(near_);
    for (const Pair& pair : near_) {
        const Object& a = objects_[pair.first];
        const Object& b = objects_[pair.second];
        if (!selection_.has(pair.first, pair.second)) continue;
        if (frame > 0 && !a.moved && !b.moved) {
            go_on(pair, frame);
            continue;
        }
        ++result_.tested;
        if (std::optional<Meeting> met = meeting(a, b)) found(pair, frame, *std::move(met));
    }
    close_all_but(frame);
}

CheckResult Checker::finish(std::size_t frames) {
    close_all_but(frames);
    std::sort(result_.findings.begin(), result_.findings.end(), [](const Finding& a, const Finding& b) {
        return std::tie(a.a, a.b, a.first) < std::tie(b.a, b.b, b.first);
    });
    result_.possible = selection_.count(objects_.size()) * frames;
    return std::move(result_);
}

}  // namespace

bool describes(std::string_view pattern, const Object& object) {
    return matches(pattern, object.path) || matches(pattern, object.name);
}

Result<CheckResult> check(Objects& objects, const std::vector<double>& times, const CheckOptions& options,
                          ProgressCall progress) {
    Checker checker(objects, options);
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
        if (frame > 0)
            if (std::optional<Problem> problem = objects.go_to(times[frame])) return *std::move(problem);
        checker.look_at(frame);
        progress(frame + 1, times.size());
    }
    return checker.finish(times.size());
}

}  // namespace abut::tool
