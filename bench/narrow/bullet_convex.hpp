#pragma once

// Scenes of convex shapes in Bullet's types. Included by files that use Bullet.

#include "../bullet.hpp"
#include "../each_pair.hpp"
#include "../peers.hpp"

#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btDiscreteCollisionDetectorInterface.h>

namespace abut::bench::bullet {

inline std::unique_ptr<btConvexShape> shape_of(const Sphere& sphere) {
    return std::make_unique<btSphereShape>(sphere.radius);
}
inline std::unique_ptr<btConvexShape> shape_of(const Box3& box) {
    auto result = std::make_unique<btBoxShape>(to_bullet(box.half));
    result->setMargin(0);
    return result;
}
inline std::unique_ptr<btConvexShape> shape_of(const Capsule3& capsule) {
    return std::make_unique<btCapsuleShape>(capsule.radius, capsule.b.y - capsule.a.y);
}
inline std::unique_ptr<btConvexShape> shape_of(const Polyhedron& hull) {
    auto result = std::make_unique<btConvexHullShape>();
    for (const Vec3& point : hull.points()) result->addPoint(to_bullet(point), false);
    result->recalcLocalAabb();
    result->setMargin(0);
    result->initializePolyhedralFeatures();
    return result;
}

struct Pair {
    const btConvexShape* a;
    const btConvexShape* b;
    btDiscreteCollisionDetectorInterface::ClosestPointInput input;
};

struct Scene {
    explicit Scene(const std::vector<scenes::AnyConvex<3>>& all) {
        for (const scenes::AnyConvex<3>& shape : all)
            shapes.push_back(std::visit([](const auto& s) { return shape_of(s); }, shape));
    }
    /// Pairs farther apart than `reach` may be unanswered.
    explicit Scene(const scenes::ConvexPairs<3>& scene, btScalar reach = BT_LARGE_FLOAT) : Scene(scene.shapes) {
        for (const auto& [a, b] : scene.pairs) {
            Pair pair{shapes[a.shape].get(), shapes[b.shape].get(), {}};
            pair.input.m_transformA = to_bullet(a.pose);
            pair.input.m_transformB = to_bullet(b.pose);
            if (reach < BT_LARGE_FLOAT)
                pair.input.m_maximumDistanceSquared = btPow(reach + pair.a->getMargin() + pair.b->getMargin(), 2);
            pairs.push_back(pair);
        }
    }

    std::vector<std::unique_ptr<btConvexShape>> shapes;
    std::vector<Pair> pairs;
};

/// Runs a query for each pair.
template <class Question>
Side side(const scenes::ConvexPairs<3>& scene, Question question, btScalar reach = BT_LARGE_FLOAT) {
    return {"bullet", each_pair(std::make_shared<const Scene>(scene, reach), std::move(question))};
}

/// Receives all contact points of a pair; stores the deepest.
struct Points : btStorageResult {
    void setShapeIdentifiersA(int, int) override {}
    void setShapeIdentifiersB(int, int) override {}
    void addContactPoint(const btVector3& normal, const btVector3& point, btScalar distance) override {
        btStorageResult::addContactPoint(normal, point, distance);
        ++count;
    }
    double depth_or_none() const { return count > 0 && m_distance <= 0 ? -double{m_distance} : -1; }

    int count = 0;
};

/// GJK, and EPA for overlaps.
void find_closest(const Pair& pair, Points& points);

}  // namespace abut::bench::bullet
