#pragma once

// A scene as it stands in a file: a tree of named nodes, the triangles they carry, and how the nodes move.
// Plain data, in the file's own units and axes; nothing here knows which format it came from.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// Triangles as an importer found them. Points may be there more than once, or be used by no triangle.
struct Geometry {
    std::string name;  ///< of the mesh it came from
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    /// One a point, of any length, where they were asked for and the file has them; else none.
    std::vector<Vec3> normals = {};
    /// Triangles of zero area that the file has too.
    std::uint64_t left_out = 0;
};

struct SceneNode {
    static constexpr std::uint32_t no_parent = std::numeric_limits<std::uint32_t>::max();

    std::string name;  ///< empty for an importer's helper node, which has no part in paths
    std::uint32_t parent = no_parent;
    glm::dmat4 local{1.0};                  ///< into the parent's space; any affine map
    std::vector<std::uint32_t> geometries;  ///< indices into Scene::geometries
};

enum class Interpolation : std::uint8_t { linear, step, cubic };

/// Values at times in seconds, in order of time; before the first and after the last the value stays.
/// Rotations are interpolated along the shortest arc.
template <class Value>
struct KeyTrack {
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> times;
    std::vector<Value> values;        ///< one for each time
    std::vector<Value> in_tangents;   ///< one for each time if cubic, else none; per second, before the key
    std::vector<Value> out_tangents;  ///< the same, after the key
};

/// How one node moves: its local transform is translation * rotation * scale.
/// Where a track has no keys, that part stays as it is in the node's own transform.
struct NodeMotion {
    std::uint32_t node = 0;
    KeyTrack<glm::dvec3> translation;
    KeyTrack<glm::dquat> rotation;
    KeyTrack<glm::dvec3> scale;
};

/// A clip. Times of its keys count from `start`.
struct Animation {
    std::string name;
    double start = 0;   ///< seconds on the scene's own clock
    double length = 0;  ///< seconds
    std::vector<NodeMotion> motions;
};

/// A node some of whose triangles have no area, and are left out. If it has no others it has no geometry and no shape.
struct NodeLeftOut {
    std::uint32_t node = 0;
    std::uint64_t triangles = 0;
};

/// The clips share one clock: those that move different nodes run together, those that move the same node one after
/// another (see `schedule`). A node follows the latest of its clips that has begun; before the first of them it rests.
struct Scene {
    std::vector<Geometry> geometries;
    std::vector<SceneNode> nodes;  ///< parents before their children
    std::vector<Animation> animations;
    std::vector<std::string> warnings;  ///< what was left out or taken differently, one line each
    std::vector<NodeLeftOut> left_out;  ///< in the order of the nodes, without those of which nothing is left out
};

/// The names on the way to a node, joined by '/'. Unique in a scene that `read_scene` made.
std::string path(const Scene& scene, std::size_t node);

/// Gives every animation its start: each begins as soon as no earlier one that moves a node of its own is running.
void schedule(Scene& scene);

/// The times of all keys, in order, thinned to at most `max_per_second`; the first and the last are always there.
/// {0} for a scene without animation.
std::vector<double> key_times(const Scene& scene, double max_per_second = 30);

/// The times at which a node may begin to move otherwise, in order: those of all keys, and the starts of the clips.
std::vector<double> motion_times(const Scene& scene);

/// `count` >= 1 times evenly spread from the first key to the last; {0} for a scene without animation.
std::vector<double> frame_times(const Scene& scene, std::size_t count);

/// Every node's transform into the world at a time in seconds, in the order of the nodes.
void world_matrices(const Scene& scene, double time, std::vector<glm::dmat4>& out);

/// The same just before that time: where a node jumps then, as by a step, two keys at one time or the start of its next
/// clip, it is still where it was.
void world_matrices_before(const Scene& scene, double time, std::vector<glm::dmat4>& out);

}  // namespace abut
