#include "tool/objects/scene_objects.hpp"
#include "tool/objects/transforms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/gtc/quaternion.hpp>

namespace abut::tool {
namespace {

// Tolerance of a stage's motion against the true motion, relative to the object's radius.
constexpr double tolerance = 2.5e-4;
// A motion of rotations and translations that is shorter than this deviates from uniform motion by less than the
// tolerance.
// Relative to the object's radius.
constexpr double short_motion = 0.05;
constexpr double max_stages = 1024;

// Seconds. An object jumps if it leaves its own bounds within this time and hardly moves for as long before and after.
// Exporters that sample 20 or more frames per second write jumps this way.
constexpr double jump_time = 0.05;
constexpr double max_speed_ratio = 0.25;

double surface_distance(const Pose3& a, const Pose3& b, double reach) {
    const glm::dquat p(a.rotation), q(b.rotation);
    const glm::dquat difference = glm::dot(p, q) < 0 ? p + q : p - q;
    return glm::length(glm::dvec3(a.position) - glm::dvec3(b.position)) + 2 * reach * glm::length(difference);
}

}  // namespace

struct SceneObjects::SmoothInterval {
    double from = 0, to = 0;
    std::vector<glm::dmat4> begin, end;             ///< per node
    double first_key = 0, last_key = 0;             ///< keys that enclose the interval
    std::array<std::vector<glm::dmat4>, 4> around;  ///< two before and two after these keys; computed on demand
};

std::vector<std::string> SceneObjects::discontinuous() const {
    return paths_where(was_discontinuous_);
}

// Returns nothing if the transform does more than rotate and translate since the shape was baked.
std::optional<Pose3> SceneObjects::pose_of(std::size_t i, const glm::dmat4& matrix) const {
    if (matrix == nodes_[i].matrix) return objects_[i].pose;
    const std::optional<glm::dmat3> rotation = rotation_since(nodes_[i].baked, glm::dmat3(matrix));
    if (!rotation || !is_finite(matrix)) return std::nullopt;
    return Pose3{Vec3(matrix[3]), glm::qua<float>(glm::normalize(glm::quat_cast(*rotation)))};
}

std::optional<Motion3> SceneObjects::motion_of(std::size_t i, const glm::dmat4& from, const glm::dmat4& to) const {
    const std::optional<Pose3> begin = pose_of(i, from), end = pose_of(i, to);
    if (!begin || !end || !abut::detail::is_finite(begin->position) || !abut::detail::is_finite(end->position))
        return std::nullopt;
    return Motion3::between(*begin, *end);
}

// Number of stages for an interval between two keys, so that each object moves uniformly on each stage. The deviation
// of a smooth curve from its chord is quadratic in the length of the chord.
int SceneObjects::count_stages(const SmoothInterval& interval) {
    double longest = 0;
    std::vector<std::pair<std::size_t, Motion3>> moving;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        const std::uint32_t node = nodes_[i].node;
        if (!objects_[i].present || (!has_curves_ && interval.begin[node] == interval.end[node])) continue;
        const std::optional<Motion3> motion = motion_of(i, interval.begin[node], interval.end[node]);
        if (!motion) continue;
        const double radius = static_cast<double>(objects_[i].radius);
        longest = std::max(longest, speed(*motion, static_cast<double>(objects_[i].reach)) / radius);
        moving.emplace_back(i, *motion);
    }
    if (moving.empty() || (!has_curves_ && longest < short_motion)) return 1;

    double stages = 1;
    for (const double fraction : {0.25, 0.5, 0.75}) {
        world_matrices(scene_, interval.from + (interval.to - interval.from) * fraction, matrices_);
        for (const auto& [i, motion] : moving) {
            const std::optional<Pose3> actual = pose_of(i, matrices_[nodes_[i].node]);
            if (!actual) continue;
            const Pose3 expected = pose_at(motion, static_cast<float>(fraction));
            const double rounding = 1e-6 * static_cast<double>(glm::length(actual->position));
            const double allowed = tolerance * static_cast<double>(objects_[i].radius) + rounding;
            const double deviation = surface_distance(*actual, expected, static_cast<double>(objects_[i].reach));
            stages = std::max(stages, std::ceil(std::sqrt(deviation / allowed)));
        }
    }
    return static_cast<int>(std::min(stages, max_stages));
}

bool SceneObjects::jumps(std::size_t i, SmoothInterval& interval) const {
    const double length = interval.last_key - interval.first_key;
    const bool is_entire_animation = motion_times_.back() - motion_times_.front() <= 4 * jump_time;
    if (length > jump_time || is_entire_animation) return false;
    const auto distance_between = [&](const std::vector<glm::dmat4>& from, const std::vector<glm::dmat4>& to) {
        const std::uint32_t node = nodes_[i].node;
        const std::optional<Motion3> motion = motion_of(i, from[node], to[node]);
        return motion ? speed(*motion, static_cast<double>(objects_[i].reach)) : 0;
    };
    const double jump_length = distance_between(interval.begin, interval.end) / (interval.to - interval.from) * length;
    if (jump_length <= 2 * static_cast<double>(objects_[i].radius)) return false;
    const double times[] = {interval.first_key - 2 * jump_time, interval.first_key - jump_time,
                            interval.last_key + jump_time, interval.last_key + 2 * jump_time};
    if (interval.around[0].empty())
        for (std::size_t k = 0; k < 4; ++k) world_matrices(scene_, times[k], interval.around[k]);
    const double before = distance_between(interval.around[0], interval.around[1]),
                 after = distance_between(interval.around[2], interval.around[3]);
    return std::max(before, after) / jump_time < max_speed_ratio * jump_length / length;
}

// The motion of an object on a stage of an interval.
StageMotion SceneObjects::motion_in_stage(std::size_t i, SmoothInterval& interval, const glm::dmat4& from,
                                          const glm::dmat4& to, Motion3& motion) {
    if (!objects_[i].present) return StageMotion::discontinuous;
    const std::optional<Motion3> found = motion_of(i, from, to);
    if (found && from == to) {
        motion = {found->from, {}, {}};
        return StageMotion::rests;
    }
    if (!found || jumps(i, interval)) {
        was_discontinuous_[i] = true;
        return StageMotion::discontinuous;
    }
    motion = *found;
    return StageMotion::moves;
}

void SceneObjects::each_stage(double from, double to, FunctionRef<void(const Stage<3>&)> visit) {
    SmoothInterval interval;
    Stage<3> stage;
    stage.parts.resize(objects_.size());
    stage.motions.resize(objects_.size());
    std::vector<glm::dmat4> begin, end;
    auto next = std::upper_bound(motion_times_.begin(), motion_times_.end(), from);
    for (interval.from = from; interval.from < to; interval.from = interval.to) {
        interval.first_key = next == motion_times_.begin() ? interval.from : *(next - 1);
        interval.last_key = next == motion_times_.end() ? to : *next;
        interval.to = std::min(interval.last_key, to);
        if (next != motion_times_.end()) ++next;
        world_matrices(scene_, interval.from, interval.begin);
        world_matrices_before(scene_, interval.to, interval.end);
        for (std::vector<glm::dmat4>& matrices : interval.around) matrices.clear();
        const int stages = count_stages(interval);
        end = interval.begin;
        for (int index = 0; index < stages; ++index) {
            begin.swap(end);
            stage.from = interval.from + (interval.to - interval.from) * index / stages;
            stage.to = index + 1 == stages ? interval.to
                                           : interval.from + (interval.to - interval.from) * (index + 1) / stages;
            if (index + 1 == stages)
                end = interval.end;
            else
                world_matrices(scene_, stage.to, end);
            for (std::size_t i = 0; i < objects_.size(); ++i) {
                const std::uint32_t node = nodes_[i].node;
                stage.parts[i] = motion_in_stage(i, interval, begin[node], end[node], stage.motions[i]);
            }
            visit(stage);
        }
    }
}

}  // namespace abut::tool
