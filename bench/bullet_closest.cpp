// Bullet's distances and decisions.

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

/// Keeps what a collision algorithm tells, and hands it on to no manifold.
struct Told : btManifoldResult {
    using btManifoldResult::btManifoldResult;
    void addContactPoint(const btVector3&, const btVector3&, btScalar told) override { distance = told; }
    double distance = 0;
};

/// An algorithm as btCollisionDispatcher keeps one for each pair of objects. Those used here remember nothing but what
/// is in their manifold, which stays empty: one does for all pairs.
template <class Algorithm>
struct Kept {
    template <class... Rest>
    explicit Kept(const Rest&... rest) : algorithm(&manifold, {}, nullptr, nullptr, rest...) {}

    btCollisionObjectWrapper placed(const btConvexShape* shape, const btTransform& pose) const {
        return {nullptr, shape, &object, pose, -1, -1};
    }

    btCollisionObject object;
    btPersistentManifold manifold;
    Algorithm algorithm;
};

/// GJK of the cores of two shapes, from the axis it found last where frames are coherent.
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

/// For btMprPenetration.h: a shape where it is.
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
    const auto kept = std::make_shared<Kept<btConvexConvexAlgorithm>>(nullptr, 0, 0);
    return side(scene, [kept, info = btDispatcherInfo()](const Pair& pair, std::size_t) -> double {
        const btCollisionObjectWrapper a = kept->placed(pair.a, pair.input.m_transformA);
        const btCollisionObjectWrapper b = kept->placed(pair.b, pair.input.m_transformB);
        Told told(&a, &b);
        told.m_closestPointDistanceThreshold = BT_LARGE_FLOAT;
        kept->algorithm.processCollision(&a, &b, info, &told);
        return told.distance;
    });
}

Side bullet_closest_of_sphere_and_box(const scenes::ConvexPairs<3>& scene) {
    const auto kept = std::make_shared<Kept<btSphereBoxCollisionAlgorithm>>(false);
    return side(scene, [kept](const Pair& pair, std::size_t) -> double {
        const btCollisionObjectWrapper box = kept->placed(pair.b, pair.input.m_transformB);
        btVector3 on_box, normal;
        btScalar distance = 0;
        kept->algorithm.getSphereDistance(&box, on_box, normal, distance, pair.input.m_transformA.getOrigin(),
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
