// Bullet's mesh, asked through its dispatcher as btCollisionWorld::contactPairTest does.

#include "bullet.hpp"
#include "levels.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

namespace abut::bench {

namespace {

struct BulletLevel {
    /// Its arrays are not const, though nothing is written to them.
    explicit BulletLevel(const LevelScene& scene)
        : points(scene.points),
          triangles(scene.triangles),
          arrays(static_cast<int>(triangles.size()), reinterpret_cast<int*>(triangles.data()), sizeof(glm::uvec3),
                 static_cast<int>(points.size()), &points[0].x, sizeof(Vec3)),
          mesh(&arrays, true),
          dispatcher(&configuration),
          world(&dispatcher, &broad_phase, &configuration) {
        mesh.setMargin(0);
        if (const auto* box = std::get_if<Box3>(&scene.shape)) {
            shape = std::make_unique<btBoxShape>(to_bullet(box->half));
            shape->setMargin(0);
        } else {
            const Capsule3& capsule = std::get<Capsule3>(scene.shape);
            shape = std::make_unique<btCapsuleShape>(capsule.radius, capsule.b.y - capsule.a.y);
        }
        ground.setCollisionShape(&mesh);
        thing.setCollisionShape(shape.get());
        for (const Pose3& pose : scene.poses) poses.push_back(to_bullet(pose));
    }

    bool touches(std::size_t i) {
        struct Any final : btCollisionWorld::ContactResultCallback {
            btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                                     const btCollisionObjectWrapper*, int, int) override {
                found = found || point.getDistance() <= 0;
                return 0;
            }
            bool found = false;
        };
        thing.setWorldTransform(poses[i]);
        Any any;
        world.contactPairTest(&thing, &ground, any);
        return any.found;
    }

    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    btTriangleIndexVertexArray arrays;
    btBvhTriangleMeshShape mesh;
    std::unique_ptr<btConvexShape> shape;
    btCollisionObject ground, thing;
    std::vector<btTransform> poses;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher;
    btDbvtBroadphase broad_phase;
    btCollisionWorld world;
};

}  // namespace

Side bullet_level_overlaps(const SharedLevelScene& scene) {
    return {"bullet", [level = std::make_shared<BulletLevel>(*scene)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = level->touches(i) ? 1 : 0;
            }};
}

}  // namespace abut::bench
