// Distances and decisions against Bullet's GJK and EPA.

#include "../../bench/bullet.hpp"

#include "compare.hpp"

#include <memory>

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace abut::differential {
namespace {

using bench::to_bullet;

// Balls and capsules are their margin; the others are told to have none, which would round them.

std::unique_ptr<btConvexShape> shape_of(const Box3& box) {
    auto result = std::make_unique<btBoxShape>(to_bullet(box.half));
    result->setMargin(0);
    return result;
}
std::unique_ptr<btConvexShape> shape_of(const Sphere& ball) {
    return std::make_unique<btSphereShape>(ball.radius);
}
std::unique_ptr<btConvexShape> shape_of(const Capsule3& capsule) {
    return std::make_unique<btCapsuleShape>(capsule.radius, capsule.b.y - capsule.a.y);
}
std::unique_ptr<btConvexShape> shape_of(const Polyhedron& hull) {
    auto result = std::make_unique<btConvexHullShape>();
    for (const Vec3& point : hull.points()) result->addPoint(to_bullet(point), false);
    result->recalcLocalAabb();
    result->setMargin(0);
    return result;
}

struct Point : btStorageResult {
    void setShapeIdentifiersA(int, int) override {}
    void setShapeIdentifiersB(int, int) override {}
    void addContactPoint(const btVector3& normal, const btVector3& point, btScalar distance) override {
        btStorageResult::addContactPoint(normal, point, distance);
        found = true;
    }
    bool found = false;
};

std::optional<Answer> ask_bullet(const Body& a, const Body& b) {
    const auto make = [](const Body& body) {
        return std::visit([](const auto& shape) { return shape_of(shape); }, body.shape);
    };
    const std::unique_ptr<btConvexShape> shape_a = make(a), shape_b = make(b);
    btDiscreteCollisionDetectorInterface::ClosestPointInput input;
    input.m_transformA = to_bullet(a.pose);
    input.m_transformB = to_bullet(b.pose);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    Point point;
    btGjkPairDetector(shape_a.get(), shape_b.get(), &simplex, &penetration).getClosestPoints(input, point, nullptr);
    if (!point.found) return {};
    const btVector3& to_a = point.m_normalOnSurfaceB;
    return Answer{point.m_distance, -DVec<3>(to_a.x(), to_a.y(), to_a.z())};
}

TEST(Bullet, AgreesOnDistancesAndOverlaps) {
    const Tally tally = compare("bullet", ask_bullet, 200);
    EXPECT_LE(tally.wrong_but_for_depths(), tally.pairs / 200) << "too often wrong to tell anything";
    EXPECT_LE(tally.too_small + tally.too_large, tally.pairs / 200);
}

}  // namespace
}  // namespace abut::differential
