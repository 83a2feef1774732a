#pragma once

// Ray casts against one mesh, and the peers' answers: one file per peer. One value per ray: the distance, or -1 for a
// miss; for any hit 1 or 0. A build job reports the distance of a ray afterwards.

#include "../bench.hpp"
#include <abut/math/ray.hpp>

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::bench {

struct RayMesh {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    std::vector<Ray3> rays;
};
using SharedRayMesh = std::shared_ptr<const RayMesh>;

/// Rays from above the ground to another point of it: most travel far just above it.
SharedRayMesh terrain_rays(std::uint32_t columns);

enum class Quality { usual, high };
enum class Edges { fast, robust };

Side embree_rays(const SharedRayMesh& scene, Quality quality, Edges edges);
/// Whether a ray hits anything.
Side embree_any_hits(const SharedRayMesh& scene, Edges edges);
Side embree_mesh_build(const SharedRayMesh& scene, Quality quality);
/// btBvhTriangleMeshShape with a quantised tree.
Side bullet_rays(const SharedRayMesh& scene);
Side bullet_mesh_build(const SharedRayMesh& scene);

}  // namespace abut::bench
