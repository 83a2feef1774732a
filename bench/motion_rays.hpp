#pragma once

// Rays at one mesh, and what the peers make of it: one file a peer. One value a ray: the distance, or -1 for a miss. A
// build tells how far a ray goes afterwards.

#include "bench.hpp"
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

enum class Quality { usual, high };
enum class Edges { quick, robust };

Side embree_rays(const SharedRayMesh& scene, Quality quality, Edges edges);
Side embree_mesh_build(const SharedRayMesh& scene, Quality quality);
/// btBvhTriangleMeshShape, its tree quantised.
Side bullet_rays(const SharedRayMesh& scene);
Side bullet_mesh_build(const SharedRayMesh& scene);

}  // namespace abut::bench
