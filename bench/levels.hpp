#pragma once

// Shapes at a terrain of a hundred thousand triangles, or among convex lumps, and what the peers make of it: one file a
// peer.

#include "bench.hpp"
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
    std::vector<Polyhedron> lumps;       ///< in place of triangles
    std::variant<Box3, Capsule3> shape;  ///< about the origin; a capsule along y
    std::vector<Pose3> poses;
};
using SharedLevelScene = std::shared_ptr<const LevelScene>;

/// Whether it touches anything, 1 or 0: Bullet's contactPairTest of a mesh of its own, or a compound of hulls, which
/// finds all there is.
Side bullet_level_overlaps(const SharedLevelScene& scene);
/// One contact with triangles, without its place.
Side fcl_level_overlaps(const SharedLevelScene& scene);

/// All contacts with their places, as contactPairTest tells them; how many triangles have some.
Side bullet_level_contacts(const SharedLevelScene& scene);
/// All contacts, one a triangle.
Side fcl_level_contacts(const SharedLevelScene& scene);
/// The same without their places.
Side fcl_level_touched(const SharedLevelScene& scene);

}  // namespace abut::bench
