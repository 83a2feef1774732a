#pragma once

// Bullet's mesh with a quantised tree, of a scene's triangles.

#include "../bullet.hpp"
#include "rays.hpp"

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

namespace abut::bench {

/// Its arrays are not const, though it only reads them.
struct BulletMesh {
    explicit BulletMesh(const SharedRayMesh& mesh)
        : points(mesh->points),
          triangles(mesh->triangles),
          arrays(static_cast<int>(triangles.size()), reinterpret_cast<int*>(triangles.data()), sizeof(glm::uvec3),
                 static_cast<int>(points.size()), &points[0].x, sizeof(Vec3)),
          shape(&arrays, true) {}

    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    btTriangleIndexVertexArray arrays;
    btBvhTriangleMeshShape shape;
};

}  // namespace abut::bench
