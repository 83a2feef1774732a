#pragma once

// A 3D scene as stored in a file: a tree of named nodes, their triangle meshes and their animations.
// Plain data in the file's own units and axes, independent of the format.

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

/// An indexed triangle mesh as imported. Points may be duplicated or unused.
struct Geometry {
    std::string name;  ///< of the file's mesh
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    /// One normal per point, of any length, if normals were requested and the file has them; else empty.
    std::vector<Vec3> normals = {};
    /// Count of triangles of zero area that the file has and that are left out here.
    std::uint64_t left_out = 0;
};

struct SceneNode {
    static constexpr std::uint32_t no_parent = std::numeric_limits<std::uint32_t>::max();

    std::string name;  ///< empty for an importer's helper node, which is left out of paths
    std::uint32_t parent = no_parent;
    glm::dmat4 local{1.0};                  ///< transform to the parent's space; any affine map
    std::vector<std::uint32_t> geometries;  ///< indices into Scene::geometries
    bool is_body = false;  ///< a rigid body or a skinned character: what is at and below it is one body
};

enum class Interpolation : std::uint8_t { linear, step, cubic };

/// Keyframes: values at times in seconds, sorted by time. The value is constant before the first key and after the
/// last.
/// Rotations are interpolated along the shortest arc.
template <class Value>
struct KeyTrack {
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> times;
    std::vector<Value> values;        ///< one per time
    std::vector<Value> in_tangents;   ///< one per time if cubic, else empty; per second, before the key
    std::vector<Value> out_tangents;  ///< one per time if cubic, else empty; per second, after the key
};

/// The animation of one node: its local transform is translation * rotation * scale.
/// A component without keys stays as it is in the node's own transform.
struct NodeMotion {
    std::uint32_t node = 0;
    KeyTrack<glm::dvec3> translation;
    KeyTrack<glm::dquat> rotation;
    KeyTrack<glm::dvec3> scale;
};

/// An animation clip. Key times count from `start`.
struct Animation {
    std::string name;
    double start = 0;   ///< seconds on the scene's own clock
    double length = 0;  ///< seconds
    std::vector<NodeMotion> motions;
};

/// Count of zero-area triangles that were left out of a node. A node without other triangles has no geometry.
struct NodeLeftOut {
    std::uint32_t node = 0;
    std::uint64_t triangles = 0;
};

/// A node tree with meshes and animation clips. All clips share one clock: clips that move different nodes run at the
/// same time, clips that move the same node run one after another (see `schedule`). A node follows the latest of its
/// clips that has started; before the first one it has its own transform.
struct Scene {
    std::vector<Geometry> geometries;
    std::vector<SceneNode> nodes;  ///< parents before their children
    std::vector<Animation> animations;
    std::vector<std::string> warnings;  ///< one line each for whatever was left out or changed
    std::vector<NodeLeftOut> left_out;  ///< sorted by node; only nodes with triangles left out
};

/// The names from the root to a node, joined by '/'. Paths are unique in a scene that `read_scene` returned.
std::string path(const Scene& scene, std::size_t node);

/// Sets every animation's start: the earliest time at which no earlier animation of any of its nodes is running.
void schedule(Scene& scene);

/// All key times, sorted and thinned to at most `max_per_second`. The first and the last key time are always included.
/// Returns {0} for a scene without animation.
std::vector<double> key_times(const Scene& scene, double max_per_second = 30);

/// All times at which a node's motion may change, sorted: key times and starts of clips.
std::vector<double> motion_times(const Scene& scene);

/// `count` >= 1 evenly spaced times from the first key to the last; {0} for a scene without animation.
std::vector<double> frame_times(const Scene& scene, std::size_t count);

/// Computes every node's transform to world space at a time in seconds, in node order.
void world_matrices(const Scene& scene, double time, std::vector<glm::dmat4>& out);

/// Computes the transforms in the limit from before `time`. They differ from `world_matrices` where a node jumps at
/// that time: at a step key, at two keys of one time or at the start of its next clip.
void world_matrices_before(const Scene& scene, double time, std::vector<glm::dmat4>& out);

}  // namespace abut
