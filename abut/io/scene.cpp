#include <abut/io/scene.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace abut {
namespace {

// Seconds between consecutive clips of a node, so that the last time of one differs from the first time of the next.
constexpr double clip_gap = 1.0 / 30;

// Relative rounding error of the clock's time minus a clip's start, of the larger of the two.
constexpr double time_rounding = 1e-15;

// The segment of a track that contains a time: the key `first`, and the fraction of the segment after it.
struct KeySegment {
    std::size_t first = 0;
    double fraction = 0;
};

// Selects the limit at a jump of a track: `at` is the value after the jump, `before` the value before it.
enum class Side { at, before };

// A time in a clip at which its tracks are sampled.
struct SampleTime {
    double time = 0;
    double rounding = 0;  // error bound of `time`: a key within it counts as reached
    Side side = Side::at;
};

KeySegment find_segment(const std::vector<double>& times, const SampleTime& sample_time) {
    const auto after = sample_time.side == Side::at
                           ? std::upper_bound(times.begin(), times.end(), sample_time.time + sample_time.rounding)
                           : std::lower_bound(times.begin(), times.end(), sample_time.time - sample_time.rounding);
    if (after == times.begin()) return {};
    const auto first = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {first, 0};
    return {first, std::clamp((sample_time.time - times[first]) / (*after - times[first]), 0.0, 1.0)};
}

glm::dvec3 interpolate(const glm::dvec3& a, const glm::dvec3& b, double fraction) {
    return a + (b - a) * fraction;
}
glm::dquat interpolate(const glm::dquat& a, const glm::dquat& b, double fraction) {
    return glm::slerp(a, b, fraction);
}

// Cubic Hermite interpolation from p to q with the tangents m and n per second, t in [0, 1] over `seconds`:
// (2t^3 - 3t^2 + 1) p + (t^3 - 2t^2 + t) m + (3t^2 - 2t^3) q + (t^3 - t^2) n
template <class Value>
Value cubic(const Value& p, const Value& m, const Value& q, const Value& n, double t, double seconds) {
    const double t2 = t * t;
    const double t3 = t2 * t;
    return p * (2 * t3 - 3 * t2 + 1) + m * (seconds * (t3 - 2 * t2 + t)) + q * (3 * t2 - 2 * t3) +
           n * (seconds * (t3 - t2));
}

template <class Value>
Value sample(const KeyTrack<Value>& track, const SampleTime& sample_time) {
    const auto [i, fraction] = find_segment(track.times, sample_time);
    if (fraction == 0 || track.interpolation == Interpolation::step) return track.values[i];
    if (fraction == 1) return track.values[i + 1];
    if (track.interpolation == Interpolation::linear)
        return interpolate(track.values[i], track.values[i + 1], fraction);
    return cubic(track.values[i], track.out_tangents[i], track.values[i + 1], track.in_tangents[i + 1], fraction,
                 track.times[i + 1] - track.times[i]);
}

glm::dmat4 translated(const glm::dvec3& translation) {
    return glm::translate(glm::dmat4(1.0), translation);
}

// Components of a node's own transform, used for tracks without keys. Exact for transforms without shear.
struct TranslationRotationScale {
    glm::dvec3 translation;
    glm::dquat rotation;
    glm::dvec3 scale;
};

TranslationRotationScale decompose(const glm::dmat4& m) {
    TranslationRotationScale components{glm::dvec3(m[3]), glm::dquat(1, 0, 0, 0), glm::dvec3(1.0)};
    glm::dmat3 axes(m);
    for (int i = 0; i < 3; ++i) components.scale[i] = glm::length(axes[i]);
    if (glm::determinant(axes) < 0) components.scale.x = -components.scale.x;
    if (components.scale.x == 0 || components.scale.y == 0 || components.scale.z == 0) return components;
    for (int i = 0; i < 3; ++i) axes[i] /= components.scale[i];
    components.rotation = glm::normalize(glm::quat_cast(axes));
    return components;
}

glm::dmat4 local_at(const SceneNode& node, const NodeMotion& motion, const SampleTime& sample_time) {
    TranslationRotationScale components = decompose(node.local);
    if (!motion.translation.times.empty()) components.translation = sample(motion.translation, sample_time);
    if (!motion.rotation.times.empty()) components.rotation = glm::normalize(sample(motion.rotation, sample_time));
    if (!motion.scale.times.empty()) components.scale = sample(motion.scale, sample_time);
    return glm::scale(translated(components.translation) * glm::mat4_cast(components.rotation), components.scale);
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
    // 1. Find the active clip of each node.
    struct ActiveClip {
        const NodeMotion* motion = nullptr;
        double start = 0;
    };
    std::vector<ActiveClip> active(scene.nodes.size());
    for (const Animation& animation : scene.animations) {
        const bool is_first = animation.start <= 0;
        const bool has_begun = side == Side::at ? animation.start <= time : animation.start < time;
        if (!is_first && !has_begun) continue;
        for (const NodeMotion& motion : animation.motions) {
            ActiveClip& latest = active[motion.node];
            if (has_keys(motion) && (latest.motion == nullptr || latest.start <= animation.start))
                latest = {&motion, animation.start};
        }
    }
    // 2. Multiply from the root down; parents precede their children.
    out.resize(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const SceneNode& node = scene.nodes[i];
        const ActiveClip& latest = active[i];
        const SampleTime sample_time{time - latest.start,
                                     latest.start == 0 ? 0 : time_rounding * std::max(time, latest.start), side};
        out[i] = latest.motion == nullptr ? node.local : local_at(node, *latest.motion, sample_time);
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
    std::vector<double> free_time(scene.nodes.size(), 0.0);
    for (Animation& animation : scene.animations) {
        animation.start = 0;
        for (const NodeMotion& motion : animation.motions)
            animation.start = std::max(animation.start, free_time[motion.node]);
        for (const NodeMotion& motion : animation.motions)
            free_time[motion.node] = animation.start + animation.length + clip_gap;
    }
}

std::vector<double> key_times(const Scene& scene, double max_per_second) {
    const std::vector<double> all = all_key_times(scene);
    if (all.empty()) return {0.0};
    // Slightly less than the step, so that rounding drops no key of an animation sampled exactly at the limit.
    const double step = 0.999 / max_per_second;
    std::vector<double> times{all.front()};
    for (const double time : all)
        if (time - times.back() >= step) times.push_back(time);
    if (times.back() != all.back()) {
        if (times.size() > 1) times.pop_back();
        times.push_back(all.back());
    }
    return times;
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
