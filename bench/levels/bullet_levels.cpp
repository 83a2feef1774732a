// Bullet's mesh or compound of hulls, queried through its dispatcher as btCollisionWorld::contactPairTest does.

#include "../narrow/bullet_convex.hpp"
#include "levels.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

namespace abut::bench {

namespace {

struct BulletMesh {
    /// Its arrays are not const, though it only reads them.
    explicit BulletMesh(const LevelScene& scene)
        : points(scene.points),
          triangles(scene.triangles),
          arrays(static_cast<int>(triangles.size()), reinterpret_cast<int*>(triangles.data()), sizeof(glm::uvec3),
                 static_cast<int>(points.size()), &points[0].x, sizeof(Vec3)),
          shape(&arrays, true) {
        shape.setMargin(0);
    }

    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    btTriangleIndexVertexArray arrays;
    btBvhTriangleMeshShape shape;
};

/// With a tree of boxes.
struct BulletBrushes {
    explicit BulletBrushes(const LevelScene& scene) {
        for (const Polyhedron& brush : scene.brushes) {
            hulls.push_back(bullet::shape_of(brush));
            shape.addChildShape(btTransform::getIdentity(), hulls.back().get());
        }
        shape.createAabbTreeFromChildren();
    }

    std::vector<std::unique_ptr<btConvexShape>> hulls;
    btCompoundShape shape;
};

template <class Ground>
struct BulletLevel {
    explicit BulletLevel(const LevelScene& scene)
        : level(scene), dispatcher(&configuration), world(&dispatcher, &broad_phase, &configuration) {
        shape = std::visit([](const auto& s) { return bullet::shape_of(s); }, scene.shape);
        ground.setCollisionShape(&level.shape);
        thing.setCollisionShape(shape.get());
        for (const Pose3& pose : scene.poses) poses.push_back(to_bullet(pose));
    }

    /// The count of triangles or hulls touched. The points of one are consecutive.
    int touched(std::size_t i) {
        struct Count final : btCollisionWorld::ContactResultCallback {
            explicit Count(const btCollisionObject* of) : ground(of) {}
            btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* first, int, int of_first,
                                     const btCollisionObjectWrapper*, int, int of_second) override {
                const int triangle = first->getCollisionObject() == ground ? of_first : of_second;
                if (point.getDistance() > 0 || triangle == last) return 0;
                last = triangle;
                ++found;
                return 0;
            }
            const btCollisionObject* ground;
            int found = 0, last = -1;
        };
        thing.setWorldTransform(poses[i]);
        Count count(&ground);
        world.contactPairTest(&thing, &ground, count);
        return count.found;
    }

    Ground level;
    std::unique_ptr<btConvexShape> shape;
    btCollisionObject ground, thing;
    std::vector<btTransform> poses;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher;
    btDbvtBroadphase broad_phase;
    btCollisionWorld world;
};

template <class Ground>
Side overlaps_with(const SharedLevelScene& scene) {
    return {"bullet", [level = std::make_shared<BulletLevel<Ground>>(*scene)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = level->touched(i) > 0 ? 1 : 0;
            }};
}

}  // namespace

Side bullet_level_overlaps(const SharedLevelScene& scene) {
    return scene->brushes.empty() ? overlaps_with<BulletMesh>(scene) : overlaps_with<BulletBrushes>(scene);
}
Side bullet_level_contacts(const SharedLevelScene& scene) {
    return {"bullet", [level = std::make_shared<BulletLevel<BulletMesh>>(*scene)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = level->touched(i);
            }};
}

}  // namespace abut::bench
