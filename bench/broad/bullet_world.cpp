// Bullet's world of collision objects, which has no solver.

#include "../bullet.hpp"
#include "crowd.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

namespace abut::bench {

namespace {

std::unique_ptr<btConvexShape> bullet_shape(const Sphere& sphere) {
    return std::make_unique<btSphereShape>(sphere.radius);
}
/// With a margin, which rounds the corners for GJK, of a thousandth of the size: without one it finds no contacts.
std::unique_ptr<btConvexShape> bullet_shape(const Box3& box) {
    auto result = std::make_unique<btBoxShape>(to_bullet(box.half));
    result->setMargin(1e-3f * std::min({box.half.x, box.half.y, box.half.z}));
    return result;
}
std::unique_ptr<btConvexShape> bullet_shape(const Capsule3& capsule) {
    return std::make_unique<btCapsuleShape>(capsule.radius, capsule.b.y - capsule.a.y);
}

struct Shaken {
    explicit Shaken(const Crowd<3>& items) : shaken(items) {
        // A fixed object's AABB is as of its addition.
        world.setForceUpdateAllAabbs(false);
        for (std::size_t i = 0; i < items.items.size(); ++i) {
            const auto& item = items.items[i];
            shapes.push_back(std::visit([](const auto& shape) { return bullet_shape(shape); }, item.shape));
            btCollisionObject& object = *objects.emplace_back(std::make_unique<btCollisionObject>());
            object.setCollisionShape(shapes.back().get());
            object.setWorldTransform(to_bullet(shaken.poses[i]));
            using Filter = btBroadphaseProxy;
            if (item.fixed) {
                world.addCollisionObject(&object, Filter::StaticFilter, Filter::AllFilter ^ Filter::StaticFilter);
            } else {
                object.setCollisionFlags(0);
                world.addCollisionObject(&object);
            }
        }
    }
    /// Whether a contact point is not apart.
    static bool touches(const btPersistentManifold& manifold) {
        for (int i = 0; i < manifold.getNumContacts(); ++i)
            if (manifold.getContactPoint(i).getDistance() <= 0) return true;
        return false;
    }

    ShakenCrowd<3> shaken;
    std::vector<std::unique_ptr<btConvexShape>> shapes;
    std::vector<std::unique_ptr<btCollisionObject>> objects;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broad_phase;
    btCollisionWorld world{&dispatcher, &broad_phase, &configuration};
};

}  // namespace

Side bullet_world(const Crowd<3>& crowd) {
    const auto state = std::make_shared<Shaken>(crowd);
    const auto run = [state](std::span<double> values) {
        for (std::size_t i = 0; i < state->objects.size(); ++i)
            if (!state->shaken.crowd.items[i].fixed)
                state->objects[i]->setWorldTransform(to_bullet(state->shaken.poses[i]));
        state->world.performDiscreteCollisionDetection();
        std::size_t touching = 0;
        for (int i = 0; i < state->dispatcher.getNumManifolds(); ++i)
            touching += Shaken::touches(*state->dispatcher.getManifoldByIndexInternal(i)) ? 1u : 0u;
        values[0] = static_cast<double>(touching);
    };
    return {"bullet", run, [state] { state->shaken.shake(); }};
}

}  // namespace abut::bench
