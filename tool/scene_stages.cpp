#include "scene_objects.hpp"
#include "transforms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/gtc/quaternion.hpp>

namespace abut::tool {
namespace {

// In parts of an object's size: how far it may be off the motion that a stage has of it.
constexpr double tolerance = 2.5e-4;
// In parts of an object's size: a way that is shorter than this bends no farther than that if it is made of turns and
// straight lines.
constexpr double short_way = 0.05;
constexpr double max_pieces = 1024;

// Seconds: what leaves its own place within this, and hardly moves as long before and after, jumps. It is how exporters
// write a jump that sample every frame, 20 or more a second.
constexpr double jump_time = 0.05;
constexpr double hardly = 0.25;

double apart(const Pose3& a, const Pose3& b, double reach) {
    const glm::dquat p(a.rotation), q(b.rotation);
    const glm::dquat same = glm::dot(p, q) < 0 ? p + q : p - q;
    return glm::length(glm::dvec3(a.position) - glm::dvec3(b.position)) + 2 * reach * glm::length(same);
}

}  // namespace

struct SceneObjects::Way {
    double from = 0, to = 0;
    std::vector<glm::dmat4> begin, end;             ///< of all nodes
    double first_key = 0, last_key = 0;             ///< around it
    std::array<std::vector<glm::dmat4>, 4> around;  ///< before and after these keys, empty until they are wanted
};

std::vector<std::string> SceneObjects::unfollowed() const {
    return paths_where(was_unfollowed_);
}

// Nothing where it does more than move and turn since its shape was made.
std::optional<Pose3> SceneObjects::pose_of(std::size_t i, const glm::dmat4& matrix) const {
    if (matrix == nodes_[i].matrix) return objects_[i].pose;
    const std::optional<glm::dmat3> turn = turn_since(nodes_[i].baked, glm::dmat3(matrix));
    if (!turn || !is_finite(matrix)) return std::nullopt;
    return Pose3{Vec3(matrix[3]), glm::qua<float>(glm::normalize(glm::quat_cast(*turn)))};
}

std::optional<Motion3> SceneObjects::motion_of(std::size_t i, const glm::dmat4& from, const glm::dmat4& to) const {
    const std::optional<Pose3> begin = pose_of(i, from), end = pose_of(i, to);
    if (!begin || !end || !abut::is_finite(begin->position) || !abut::is_finite(end->position)) return std::nullopt;
    return Motion3::between(*begin, *end);
}

// Into how many stages a way between two keys is cut, so that on each of them all objects go straight and turn evenly.
// How far a smooth way is off its chord goes with the square of its length.
int SceneObjects::count_pieces(const Way& way) {
    double longest = 0;
    std::vector<std::pair<std::size_t, Motion3>> moving;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        const std::uint32_t node = nodes_[i].node;
        if (!objects_[i].present || (!has_curves_ && way.begin[node] == way.end[node])) continue;
        const std::optional<Motion3> motion = motion_of(i, way.begin[node], way.end[node]);
        if (!motion) continue;
        const double radius = static_cast<double>(objects_[i].radius);
        longest = std::max(longest, speed(*motion, static_cast<double>(objects_[i].reach)) / radius);
        moving.emplace_back(i, *motion);
    }
    if (moving.empty() || (!has_curves_ && longest < short_way)) return 1;

    double pieces = 1;
    for (const double fraction : {0.25, 0.5, 0.75}) {
        world_matrices(scene_, way.from + (way.to - way.from) * fraction, matrices_);
        for (const auto& [i, motion] : moving) {
            const std::optional<Pose3> there = pose_of(i, matrices_[nodes_[i].node]);
            if (!there) continue;
            const Pose3 expected = pose_at(motion, static_cast<float>(fraction));
            const double rounding = 1e-6 * static_cast<double>(glm::length(there->position));
            const double allowed = tolerance * static_cast<double>(objects_[i].radius) + rounding;
            const double off = apart(*there, expected, static_cast<double>(objects_[i].reach));
            pieces = std::max(pieces, std::ceil(std::sqrt(off / allowed)));
        }
    }
    return static_cast<int>(std::min(pieces, max_pieces));
}

bool SceneObjects::jumps(std::size_t i, Way& way) const {
    const double length = way.last_key - way.first_key;
    const bool is_all = motion_times_.back() - motion_times_.front() <= 4 * jump_time;
    if (length > jump_time || is_all) return false;
    const auto way_between = [&](const std::vector<glm::dmat4>& from, const std::vector<glm::dmat4>& to) {
        const std::uint32_t node = nodes_[i].node;
        const std::optional<Motion3> motion = motion_of(i, from[node], to[node]);
        return motion ? speed(*motion, static_cast<double>(objects_[i].reach)) : 0;
    };
    const double gone = way_between(way.begin, way.end) / (way.to - way.from) * length;
    if (gone <= 2 * static_cast<double>(objects_[i].radius)) return false;
    const double times[] = {way.first_key - 2 * jump_time, way.first_key - jump_time, way.last_key + jump_time,
                            way.last_key + 2 * jump_time};
    if (way.around[0].empty())
        for (std::size_t k = 0; k < 4; ++k) world_matrices(scene_, times[k], way.around[k]);
    const double before = way_between(way.around[0], way.around[1]), after = way_between(way.around[2], way.around[3]);
    return std::max(before, after) / jump_time < hardly * gone / length;
}

// How an object takes part in a stage of a way, with its motion on the stage.
Part SceneObjects::part_in(std::size_t i, Way& way, const glm::dmat4& from, const glm::dmat4& to, Motion3& motion) {
    if (!objects_[i].present) return Part::unfollowed;
    const std::optional<Motion3> found = motion_of(i, from, to);
    if (found && from == to) {
        motion = {found->from, {}, {}};
        return Part::rests;
    }
    if (!found || jumps(i, way)) {
        was_unfollowed_[i] = true;
        return Part::unfollowed;
    }
    motion = *found;
    return Part::moves;
}

void SceneObjects::each_stage(double from, double to, FunctionRef<void(const Stage<3>&)> visit) {
    Way way;
    Stage<3> stage;
    stage.parts.resize(objects_.size());
    stage.motions.resize(objects_.size());
    std::vector<glm::dmat4> begin, end;
    auto next = std::upper_bound(motion_times_.begin(), motion_times_.end(), from);
    for (way.from = from; way.from < to; way.from = way.to) {
        way.first_key = next == motion_times_.begin() ? way.from : *(next - 1);
        way.last_key = next == motion_times_.end() ? to : *next;
        way.to = std::min(way.last_key, to);
        if (next != motion_times_.end()) ++next;
        world_matrices(scene_, way.from, way.begin);
        world_matrices_before(scene_, way.to, way.end);
        for (std::vector<glm::dmat4>& matrices : way.around) matrices.clear();
        const int pieces = count_pieces(way);
        end = way.begin;
        for (int piece = 0; piece < pieces; ++piece) {
            begin.swap(end);
            stage.from = way.from + (way.to - way.from) * piece / pieces;
            stage.to = piece + 1 == pieces ? way.to : way.from + (way.to - way.from) * (piece + 1) / pieces;
            if (piece + 1 == pieces)
                end = way.end;
            else
                world_matrices(scene_, stage.to, end);
            for (std::size_t i = 0; i < objects_.size(); ++i) {
                const std::uint32_t node = nodes_[i].node;
                stage.parts[i] = part_in(i, way, begin[node], end[node], stage.motions[i]);
            }
            visit(stage);
        }
    }
}

}  // namespace abut::tool
