// Bullet's narrow phase: GJK, EPA, the box detector, polyhedral clipping and the convex cast, called directly, each
// pair from nothing.

#include "bullet.hpp"
#include "peers.hpp"

#include <memory>
#include <type_traits>
#include <utility>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPolyhedralContactClipping.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace abut::bench {

namespace {

std::unique_ptr<btConvexShape> shape_of(const Box3& box) {
    auto result = std::make_unique<btBoxShape>(to_bullet(box.half));
    result->setMargin(0);
    return result;
}
std::unique_ptr<btConvexShape> shape_of(const Capsule3& capsule) {
    return std::make_unique<btCapsuleShape>(capsule.radius, capsule.b.y - capsule.a.y);
}
std::unique_ptr<btConvexShape> shape_of(const Polyhedron& hull) {
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
    explicit Scene(const std::vector<scenes::AnyConvex>& all) {
        for (const scenes::AnyConvex& shape : all)
            shapes.push_back(std::visit([](const auto& s) { return shape_of(s); }, shape));
    }
    explicit Scene(const scenes::ConvexPairs& scene) : Scene(scene.shapes) {
        for (const auto& [a, b] : scene.pairs) {
            Pair pair{shapes[a.shape].get(), shapes[b.shape].get(), {}};
            pair.input.m_transformA = to_bullet(a.pose);
            pair.input.m_transformB = to_bullet(b.pose);
            pairs.push_back(pair);
        }
    }

    std::vector<std::unique_ptr<btConvexShape>> shapes;
    std::vector<Pair> pairs;
};

/// All contact points of a pair; the deepest is kept in full.
struct Points : btStorageResult {
    void setShapeIdentifiersA(int, int) override {}
    void setShapeIdentifiersB(int, int) override {}
    void addContactPoint(const btVector3& normal, const btVector3& point, btScalar distance) override {
        btStorageResult::addContactPoint(normal, point, distance);
        ++count;
    }
    int count = 0;
};

/// Asks a question of each pair.
template <class Question>
Side side(const scenes::ConvexPairs& scene, Question question) {
    return {"bullet", [scene = std::make_shared<const Scene>(scene), question](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = question(scene->pairs[i]);
            }};
}

void find_closest(const Pair& pair, Points& points) {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btGjkPairDetector(pair.a, pair.b, &simplex, &penetration).getClosestPoints(pair.input, points, nullptr);
}

double depth_or_none(const Points& points) {
    return points.count > 0 && points.m_distance <= 0 ? -double{points.m_distance} : -1;
}

double depth_of_boxes(const Pair& pair) {
    Points points;
    btBoxBoxDetector(static_cast<const btBoxShape*>(pair.a), static_cast<const btBoxShape*>(pair.b))
        .getClosestPoints(pair.input, points, nullptr);
    return depth_or_none(points);
}

}  // namespace

Side bullet_closest(const scenes::ConvexPairs& scene) {
    return side(scene, [](const Pair& pair) -> double {
        Points points;
        find_closest(pair, points);
        return points.m_distance;
    });
}

Side bullet_overlaps_of_boxes(const scenes::ConvexPairs& scene) {
    return side(scene, [](const Pair& pair) -> double { return depth_of_boxes(pair) >= 0 ? 1 : 0; });
}

Side bullet_contact_of_boxes(const scenes::ConvexPairs& scene) {
    return side(scene, depth_of_boxes);
}

Side bullet_contact_of_hulls(const scenes::ConvexPairs& scene) {
    constexpr btScalar threshold = 0.02f;  // Bullet's usual contact breaking threshold
    return side(scene, [](const Pair& pair) {
        Points deepest, points;
        find_closest(pair, deepest);
        if (deepest.count == 0 || deepest.m_distance > 0) return -1.0;
        const auto* a = static_cast<const btPolyhedralConvexShape*>(pair.a)->getConvexPolyhedron();
        const auto* b = static_cast<const btPolyhedralConvexShape*>(pair.b)->getConvexPolyhedron();
        btVertexArray scratch, more_scratch;
        btPolyhedralContactClipping::clipHullAgainstHull(deepest.m_normalOnSurfaceB, *a, *b, pair.input.m_transformA,
                                                         pair.input.m_transformB, deepest.m_distance - threshold,
                                                         threshold, scratch, more_scratch, points);
        return depth_or_none(deepest);
    });
}

Side bullet_raycast(const RayScene& scene) {
    struct Cast {
        const btConvexShape* shape;
        btTransform pose, from, to;
        double length;
    };
    struct Casts {
        Scene scene;
        std::vector<Cast> casts;
    };
    auto all = std::make_shared<Casts>(Casts{Scene(scene.shapes), {}});
    for (std::size_t i = 0; i < scene.rays.size(); ++i) {
        const Ray3& ray = scene.rays[i];
        all->casts.push_back(
            {all->scene.shapes[scene.targets[i].shape].get(), to_bullet(scene.targets[i].pose),
             btTransform(btQuaternion::getIdentity(), to_bullet(ray.origin)),
             btTransform(btQuaternion::getIdentity(), to_bullet(ray.origin + ray.length * ray.direction)), ray.length});
    }
    const auto ask = [all](std::span<double> values) {
        btSphereShape point(0);
        point.setMargin(0);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const Cast& cast = all->casts[i];
            btVoronoiSimplexSolver simplex;
            btConvexCast::CastResult result;
            // Squares, usually 1e-4: the cast would end 0.01 before the hull.
            result.m_subSimplexCastEpsilon = 1e-7f;
            simplex.setEqualVertexThreshold(1e-10f);
            const bool hit = btSubsimplexConvexCast(&point, cast.shape, &simplex)
                                 .calcTimeOfImpact(cast.from, cast.to, cast.pose, cast.pose, result);
            // As btCollisionWorld::rayTestSingle judges it.
            const bool counts = hit && result.m_normal.length2() > 0.0001f && result.m_fraction < 1;
            values[i] = counts ? double{result.m_fraction} * cast.length : -1;
        }
    };
    return {"bullet", ask, nullptr, 0.01};  // clipping the rays by the hulls' planes in double confirms abut's values
}

}  // namespace abut::bench
