#pragma once

// Shapes against a terrain of a hundred thousand triangles, or convex brushes, and the peers' answers: one file per
// peer.

#include "../bench.hpp"
#include <abut/math/pose.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polyhedron.hpp>

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::bench {

struct LevelScene {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    std::vector<Polyhedron> brushes;     ///< used instead of triangles
    std::variant<Box3, Capsule3> shape;  ///< about the origin; a capsule along y
    std::vector<Pose3> poses;
};
using SharedLevelScene = std::shared_ptr<const LevelScene>;

/// Overlap test, 1 or 0: Bullet's contactPairTest of a mesh of its own, or of a compound of hulls, which finds all
/// contacts.
Side bullet_level_overlaps(const SharedLevelScene& scene);
/// One contact with triangles, without its position.
Side fcl_level_overlaps(const SharedLevelScene& scene);

/// All contacts with positions, as contactPairTest reports them; the count of triangles with contacts.
Side bullet_level_contacts(const SharedLevelScene& scene);
/// All contacts, one per triangle.
Side fcl_level_contacts(const SharedLevelScene& scene);
/// All contacts without positions.
Side fcl_level_touched(const SharedLevelScene& scene);

}  // namespace abut::bench
