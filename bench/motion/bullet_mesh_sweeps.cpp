// Bullet's convex sweep at a mesh, without its broad phase.

#include "../narrow/bullet_convex.hpp"
#include "bullet_mesh.hpp"
#include "mesh_sweeps.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

namespace abut::bench {

namespace {

struct Scene {
    explicit Scene(const MeshSweeps& sweeps)
        : mesh(sweeps.scene), swept(std::visit([](const auto& s) { return bullet::shape_of(s); }, sweeps.shape)) {
        mesh.shape.setMargin(0);
        object.setCollisionShape(&mesh.shape);
    }

    double distance(const Ray3& ray) {
        const btVector3 start = to_bullet(ray.origin), end = to_bullet(ray.origin + ray.length * ray.direction);
        const btTransform from(btQuaternion::getIdentity(), start), to(btQuaternion::getIdentity(), end);
        btCollisionWorld::ClosestConvexResultCallback first(start, end);
        btCollisionWorld::objectQuerySingle(swept.get(), from, to, &object, &mesh.shape, btTransform::getIdentity(),
                                            first, 0);
        return first.hasHit() ? static_cast<double>(first.m_closestHitFraction * ray.length) : -1.0;
    }

    BulletMesh mesh;
    std::unique_ptr<btConvexShape> swept;
    btCollisionObject object;
};

}  // namespace

Side bullet_mesh_sweeps(const MeshSweeps& sweeps) {
    return {"bullet", [sweeps, scene = std::make_shared<Scene>(sweeps)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = scene->distance(sweeps.scene->rays[i]);
            }};
}

}  // namespace abut::bench
