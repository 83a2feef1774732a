// Bullet's GJK and EPA, in float as Debian builds it.

#include "peers.hpp"

#include <memory>

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace abut::differential {

using namespace detail;

namespace {

btVector3 vector(const DVec<3>& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

struct Placed {
    std::unique_ptr<btConvexShape> shape;
    btTransform transform;
};

/// Balls and boxes with a float center are Bullet's own shapes; all others are points with a margin.
Placed placed(const PeerShape& shape) {
    Placed result;
    result.transform.setIdentity();
    result.transform.setOrigin(vector(shape.center));
    const bool centered = length(shape.middle()) <= 1e-7 * shape.size;
    if (shape.form == Form::ball && centered) {
        result.shape = std::make_unique<btSphereShape>(static_cast<float>(shape.radius));
        return result;
    }
    if (shape.form == Form::box && centered) {
        result.shape = std::make_unique<btBoxShape>(vector(shape.half));
        result.shape->setMargin(0);
        const auto& [x, y, z] = shape.axes;
        btMatrix3x3 turn;
        for (int i = 0; i < 3; ++i)
            turn[i] = btVector3(static_cast<float>(x[i]), static_cast<float>(y[i]), static_cast<float>(z[i]));
        result.transform.setBasis(turn);
        return result;
    }
    auto hull = std::make_unique<btConvexHullShape>();
    for (const DVec<3>& point : shape.points) hull->addPoint(vector(point), false);
    hull->recalcLocalAabb();
    hull->setMargin(static_cast<float>(shape.radius));
    result.shape = std::move(hull);
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

}  // namespace

PeerAnswer query_bullet(const PeerShape& a, const PeerShape& b, double) {
    const Placed in_a = placed(a), in_b = placed(b);
    btDiscreteCollisionDetectorInterface::ClosestPointInput input;
    input.m_transformA = in_a.transform;
    input.m_transformB = in_b.transform;
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    Point point;
    btGjkPairDetector detector(in_a.shape.get(), in_b.shape.get(), &simplex, &penetration);
    detector.getClosestPoints(input, point, nullptr);
    if (!point.found) return {PeerAnswer::State::refused};
    const double distance = static_cast<double>(point.m_distance);
    const btVector3& to_a = point.m_normalOnSurfaceB;
    return {PeerAnswer::State::answered, distance <= 0, true, distance, -DVec<3>(to_a.x(), to_a.y(), to_a.z())};
}

}  // namespace abut::differential
