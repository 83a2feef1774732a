// Bullet's mesh: performRaycast, as btCollisionWorld::rayTestSingle calls it.

#include "bullet_mesh.hpp"

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

namespace abut::bench {

namespace {

double distance(BulletMesh& mesh, const Ray3& ray) {
    struct First final : btTriangleRaycastCallback {
        using btTriangleRaycastCallback::btTriangleRaycastCallback;
        btScalar reportHit(const btVector3&, btScalar fraction, int, int) override { return fraction; }
    };
    const btVector3 from = to_bullet(ray.origin), to = to_bullet(ray.origin + ray.length * ray.direction);
    First first(from, to);
    mesh.shape.performRaycast(&first, from, to);
    return first.m_hitFraction < 1 ? static_cast<double>(first.m_hitFraction * ray.length) : -1.0;
}

}  // namespace

Side bullet_rays(const SharedRayMesh& scene) {
    return {"bullet", [scene, mesh = std::make_shared<BulletMesh>(scene)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = distance(*mesh, scene->rays[i]);
            }};
}

Side bullet_mesh_build(const SharedRayMesh& scene) {
    return {"bullet", [scene](std::span<double> values) {
                BulletMesh mesh(scene);
                values[0] = distance(mesh, scene->rays[0]);
            }};
}

}  // namespace abut::bench
