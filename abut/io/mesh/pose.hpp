#pragma once

// Skinned meshes in the pose of the scene's first time.

#include <abut/io/scene.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/matrix_double4x4.hpp>

namespace abut::detail {

/// How much a point follows a joint.
struct Influence {
    std::uint32_t point = 0;
    std::uint32_t joint = 0;  ///< index into Skin::joints
    double weight = 0;
};

/// A geometry whose points follow joints. No other node has the geometry.
struct Skin {
    std::uint32_t node = 0, geometry = 0;
    std::vector<std::uint32_t> joints;      ///< nodes
    std::vector<glm::dmat4> inverse_binds;  ///< one per joint
    std::vector<Influence> influences;      ///< in any order; points without any stay where they are
};

/// Moves the points of all skins to where their joints have them at the scene's first time. From then on the mesh moves
/// with the root of its joints, below which it gets a node of its own. Requires a scene that is checked and scheduled.
void pose_skins(Scene& scene, std::span<const Skin> skins);

}  // namespace abut::detail
