#include <abut/io/scene.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace abut {
namespace {

// Between two clips that follow one another, so that the last moment of one isn't the first of the next.
constexpr double pause = 1.0 / 30;

// A few units in the last place: of the clock's time less a clip's start, beside the larger of the two.
constexpr double rounding = 1e-15;

// The segment of a track that holds a time: key `first`, and how far on towards the next.
struct Place {
    std::size_t first = 0;
    double fraction = 0;
};

// Where a track jumps at a time, one side sees where it jumps to, the other where from.
enum class Side { at, before };

// A time of a clip, by which its tracks are looked up.
struct Moment {
    double time = 0;
    double rounding = 0;  // by which it may be off: a key that near is met
    Side side = Side::at;
};

Place find(const std::vector<double>& times, const Moment& moment) {
    const auto after = moment.side == Side::at
                           ? std::upper_bound(times.begin(), times.end(), moment.time + moment.rounding)
                           : std::lower_bound(times.begin(), times.end(), moment.time - moment.rounding);
    if (after == times.begin()) return {};
    const auto first = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {first, 0};
    return {first, std::clamp((moment.time - times[first]) / (*after - times[first]), 0.0, 1.0)};
}

glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double fraction) {
    return a + (b - a) * fraction;
}
glm::dquat between(const glm::dquat& a, const glm::dquat& b, double fraction) {
    return glm::slerp(a, b, fraction);
}

// Hermite's cubic through p and q with the tangents m and n, t in [0, 1] over `seconds`:
// (2t^3 - 3t^2 + 1) p + (t^3 - 2t^2 + t) m + (3t^2 - 2t^3) q + (t^3 - t^2) n
template <class Value>
Value cubic(const Value& p, const Value& m, const Value& q, const Value& n, double t, double seconds) {
    const double t2 = t * t;
    const double t3 = t2 * t;
    return p * (2 * t3 - 3 * t2 + 1) + m * (seconds * (t3 - 2 * t2 + t)) + q * (3 * t2 - 2 * t3) +
           n * (seconds * (t3 - t2));
}

template <class Value>
Value sample(const KeyTrack<Value>& track, const Moment& moment) {
    const auto [i, fraction] = find(track.times, moment);
    if (fraction == 0 || track.interpolation == Interpolation::step) return track.values[i];
    if (fraction == 1) return track.values[i + 1];
    if (track.interpolation == Interpolation::linear) return between(track.values[i], track.values[i + 1], fraction);
    return cubic(track.values[i], track.out_tangents[i], track.values[i + 1], track.in_tangents[i + 1], fraction,
                 track.times[i + 1] - track.times[i]);
}

glm::dmat4 translated(const glm::dvec3& translation) {
    return glm::translate(glm::dmat4(1.0), translation);
}

// A node's own transform taken apart, for the tracks that are missing. Exact where it has no shear.
struct Parts {
    glm::dvec3 translation;
    glm::dquat rotation;
    glm::dvec3 scale;
};

Parts take_apart(const glm::dmat4& m) {
    Parts parts{glm::dvec3(m[3]), glm::dquat(1, 0, 0, 0), glm::dvec3(1.0)};
    glm::dmat3 axes(m);
    for (int i = 0; i < 3; ++i) parts.scale[i] = glm::length(axes[i]);
    if (glm::determinant(axes) < 0) parts.scale.x = -parts.scale.x;
    if (parts.scale.x == 0 || parts.scale.y == 0 || parts.scale.z == 0) return parts;
    for (int i = 0; i < 3; ++i) axes[i] /= parts.scale[i];
    parts.rotation = glm::normalize(glm::quat_cast(axes));
    return parts;
}

glm::dmat4 local_at(const SceneNode& node, const NodeMotion& motion, const Moment& moment) {
    Parts parts = take_apart(node.local);
    if (!motion.translation.times.empty()) parts.translation = sample(motion.translation, moment);
    if (!motion.rotation.times.empty()) parts.rotation = glm::normalize(sample(motion.rotation, moment));
    if (!motion.scale.times.empty()) parts.scale = sample(motion.scale, moment);
    return glm::scale(translated(parts.translation) * glm::mat4_cast(parts.rotation), parts.scale);
}

bool has_keys(const NodeMotion& motion) {
    return !motion.translation.times.empty() || !motion.rotation.times.empty() || !motion.scale.times.empty();
}

std::vector<double> all_key_times(const Scene& scene) {
    std::vector<double> times;
    for (const Animation& animation : scene.animations) {
        const auto add = [&](const std::vector<double>& keys) {
            for (const double key : keys) times.push_back(animation.start + key);
        };
        for (const NodeMotion& motion : animation.motions) {
            add(motion.translation.times);
            add(motion.rotation.times);
            add(motion.scale.times);
        }
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

void fill_matrices(const Scene& scene, double time, Side side, std::vector<glm::dmat4>& out) {
    // 1. The clip each node follows.
    struct Follows {
        const NodeMotion* motion = nullptr;
        double start = 0;
    };
    std::vector<Follows> follows(scene.nodes.size());
    for (const Animation& animation : scene.animations) {
        const bool is_first = animation.start <= 0;
        const bool has_begun = side == Side::at ? animation.start <= time : animation.start < time;
        if (!is_first && !has_begun) continue;
        for (const NodeMotion& motion : animation.motions) {
            Follows& latest = follows[motion.node];
            if (has_keys(motion) && (latest.motion == nullptr || latest.start <= animation.start))
                latest = {&motion, animation.start};
        }
    }
    // 2. Down the tree; parents come first.
    out.resize(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const SceneNode& node = scene.nodes[i];
        const Follows& latest = follows[i];
        const Moment moment{time - latest.start, latest.start == 0 ? 0 : rounding * std::max(time, latest.start), side};
        out[i] = latest.motion == nullptr ? node.local : local_at(node, *latest.motion, moment);
        if (node.parent != SceneNode::no_parent) out[i] = out[node.parent] * out[i];
    }
}

}  // namespace

std::string path(const Scene& scene, std::size_t node) {
    std::vector<const std::string*> names;
    for (std::size_t at = node; at != SceneNode::no_parent; at = scene.nodes[at].parent)
        if (!scene.nodes[at].name.empty()) names.push_back(&scene.nodes[at].name);
    std::string result;
    for (auto name = names.rbegin(); name != names.rend(); ++name) {
        if (!result.empty()) result += '/';
        result += **name;
    }
    return result;
}

void schedule(Scene& scene) {
    std::vector<double> free_from(scene.nodes.size(), 0.0);
    for (Animation& animation : scene.animations) {
        animation.start = 0;
        for (const NodeMotion& motion : animation.motions)
            animation.start = std::max(animation.start, free_from[motion.node]);
        for (const NodeMotion& motion : animation.motions)
            free_from[motion.node] = animation.start + animation.length + pause;
    }
}

std::vector<double> key_times(const Scene& scene, double max_per_second) {
    const std::vector<double> all = all_key_times(scene);
    if (all.empty()) return {0.0};
    // A little less than the step, so that keys exactly at the limit all stay in spite of rounding.
    const double step = 0.999 / max_per_second;
    std::vector<double> kept{all.front()};
    for (const double time : all)
        if (time - kept.back() >= step) kept.push_back(time);
    if (kept.back() != all.back()) {
        if (kept.size() > 1) kept.pop_back();
        kept.push_back(all.back());
    }
    return kept;
}

std::vector<double> motion_times(const Scene& scene) {
    std::vector<double> times = all_key_times(scene);
    for (const Animation& animation : scene.animations) times.push_back(animation.start);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

std::vector<double> frame_times(const Scene& scene, std::size_t count) {
    ABUT_ASSERT(count >= 1);
    const std::vector<double> keys = all_key_times(scene);
    if (keys.empty()) return {0.0};
    std::vector<double> times{keys.front()};
    const double length = keys.back() - keys.front();
    for (std::size_t i = 1; i < count; ++i)
        times.push_back(keys.front() + length * (static_cast<double>(i) / static_cast<double>(count - 1)));
    return times;
}

void world_matrices(const Scene& scene, double time, std::vector<glm::dmat4>& out) {
    fill_matrices(scene, time, Side::at, out);
}

void world_matrices_before(const Scene& scene, double time, std::vector<glm::dmat4>& out) {
    fill_matrices(scene, time, Side::before, out);
}

}  // namespace abut
