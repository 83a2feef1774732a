// Bullet's mesh: performRaycast, as btCollisionWorld::rayTestSingle calls it.

#include "../bullet.hpp"
#include "rays.hpp"

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

namespace abut::bench {

namespace {

/// Its arrays are not const, though it only reads them.
struct BulletMesh {
    explicit BulletMesh(const SharedRayMesh& mesh)
        : points(mesh->points),
          triangles(mesh->triangles),
          arrays(static_cast<int>(triangles.size()), reinterpret_cast<int*>(triangles.data()), sizeof(glm::uvec3),
                 static_cast<int>(points.size()), &points[0].x, sizeof(Vec3)),
          shape(&arrays, true) {}

    double distance(const Ray3& ray) {
        struct First final : btTriangleRaycastCallback {
            using btTriangleRaycastCallback::btTriangleRaycastCallback;
            btScalar reportHit(const btVector3&, btScalar fraction, int, int) override { return fraction; }
        };
        const auto vector = [](const Vec3& v) { return btVector3(v.x, v.y, v.z); };
        const btVector3 from = vector(ray.origin), to = vector(ray.origin + ray.length * ray.direction);
        First first(from, to);
        shape.performRaycast(&first, from, to);
        return first.m_hitFraction < 1 ? static_cast<double>(first.m_hitFraction * ray.length) : -1.0;
    }

    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    btTriangleIndexVertexArray arrays;
    btBvhTriangleMeshShape shape;
};

}  // namespace

Side bullet_rays(const SharedRayMesh& scene) {
    return {"bullet", [scene, mesh = std::make_shared<BulletMesh>(scene)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = mesh->distance(scene->rays[i]);
            }};
}

Side bullet_mesh_build(const SharedRayMesh& scene) {
    return {"bullet", [scene](std::span<double> values) { values[0] = BulletMesh(scene).distance(scene->rays[0]); }};
}

}  // namespace abut::bench
