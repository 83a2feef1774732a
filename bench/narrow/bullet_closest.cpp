// Bullet's distances and overlap tests.

#include "bullet_convex.hpp"

#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionDispatch/btSphereBoxCollisionAlgorithm.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletCollision/NarrowPhaseCollision/btMprPenetration.h>

namespace abut::bench {

using namespace bullet;

namespace {

/// Stores the result of a collision algorithm without a manifold.
struct ClosestResult : btManifoldResult {
    using btManifoldResult::btManifoldResult;
    void addContactPoint(const btVector3&, const btVector3&, btScalar distance_found) override {
        distance = distance_found;
    }
    double distance = 0;
};

/// A collision algorithm, as btCollisionDispatcher has one per pair. The algorithms used here have no state besides
/// their manifold, which stays empty: one serves all pairs.
template <class Algorithm>
struct PairAlgorithm {
    template <class... Rest>
    explicit PairAlgorithm(const Rest&... rest) : algorithm(&manifold, {}, nullptr, nullptr, rest...) {}

    btCollisionObjectWrapper placed(const btConvexShape* shape, const btTransform& pose) const {
        return {nullptr, shape, &object, pose, -1, -1};
    }

    btCollisionObject object;
    btPersistentManifold manifold;
    Algorithm algorithm;
};

/// GJK on the core shapes, warm started from the last axis for coherent frames.
class Search {
public:
    Search(const scenes::ConvexPairs<3>& scene, Frames frames)
        : keep_(frames == Frames::coherent), axes_(scene.count(), btVector3(0, 0, 0)) {}

    btGjkEpaSolver2::sResults operator()(const Pair& pair, std::size_t place) {
        btVector3& axis = axes_[place];
        if (!keep_ || axis.isZero()) axis = pair.input.m_transformA.getOrigin() - pair.input.m_transformB.getOrigin();
        btGjkEpaSolver2::sResults results;
        const bool apart =
            btGjkEpaSolver2::Distance(pair.a, pair.input.m_transformA, pair.b, pair.input.m_transformB, axis, results);
        axis = apart ? results.witnesses[0] - results.witnesses[1] : btVector3(0, 0, 0);
        return results;
    }

private:
    bool keep_;
    std::vector<btVector3> axes_;
};

/// A posed shape for btMprPenetration.h.
struct MprShape {
    const btTransform& getWorldTransform() const { return pose; }
    btVector3 getObjectCenterInWorld() const { return pose.getOrigin(); }
    btVector3 getLocalSupportWithMargin(const btVector3& direction) const {
        return shape->localGetSupportVertexNonVirtual(direction);
    }

    const btConvexShape* shape;
    const btTransform& pose;
};

}  // namespace

Side bullet_closest(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [](const Pair& pair, std::size_t) -> double {
        Points points;
        find_closest(pair, points);
        return points.m_distance;
    });
}

Side bullet_gap(const scenes::ConvexPairs<3>& scene, Frames frames) {
    Side result = side(scene, [search = Search(scene, frames)](const Pair& pair, std::size_t place) mutable {
        return double{search(pair, place).distance} - double{pair.a->getMargin()} - double{pair.b->getMargin()};
    });
    result.who = "bullet gjk";
    return result;
}

Side bullet_closest_of_capsules(const scenes::ConvexPairs<3>& scene) {
    const auto algorithm_of_pair = std::make_shared<PairAlgorithm<btConvexConvexAlgorithm>>(nullptr, 0, 0);
    return side(scene, [algorithm_of_pair, info = btDispatcherInfo()](const Pair& pair, std::size_t) -> double {
        const btCollisionObjectWrapper a = algorithm_of_pair->placed(pair.a, pair.input.m_transformA);
        const btCollisionObjectWrapper b = algorithm_of_pair->placed(pair.b, pair.input.m_transformB);
        ClosestResult result(&a, &b);
        result.m_closestPointDistanceThreshold = BT_LARGE_FLOAT;
        algorithm_of_pair->algorithm.processCollision(&a, &b, info, &result);
        return result.distance;
    });
}

Side bullet_closest_of_sphere_and_box(const scenes::ConvexPairs<3>& scene) {
    const auto algorithm_of_pair = std::make_shared<PairAlgorithm<btSphereBoxCollisionAlgorithm>>(false);
    return side(scene, [algorithm_of_pair](const Pair& pair, std::size_t) -> double {
        const btCollisionObjectWrapper box = algorithm_of_pair->placed(pair.b, pair.input.m_transformB);
        btVector3 on_box, normal;
        btScalar distance = 0;
        algorithm_of_pair->algorithm.getSphereDistance(
            &box, on_box, normal, distance, pair.input.m_transformA.getOrigin(),
            static_cast<const btSphereShape*>(pair.a)->getRadius(), BT_LARGE_FLOAT);
        return distance;
    });
}

Side bullet_overlaps_of_boxes(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [](const Pair& pair, std::size_t) -> double {
        Points points;
        btBoxBoxDetector(static_cast<const btBoxShape*>(pair.a), static_cast<const btBoxShape*>(pair.b))
            .getClosestPoints(pair.input, points, nullptr);
        return points.depth_or_none() >= 0 ? 1 : 0;
    });
}

Side bullet_overlaps(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [](const Pair& pair, std::size_t) -> double {
        const MprShape a{pair.a, pair.input.m_transformA}, b{pair.b, pair.input.m_transformB};
        btMprSimplex_t portal;
        const int found = btDiscoverPortal(a, b, btMprCollisionDescription(), &portal);
        if (found < 0) return 0;
        return found > 0 || btRefinePortal(a, b, btMprCollisionDescription(), &portal) == 0 ? 1 : 0;
    });
}

}  // namespace abut::bench
