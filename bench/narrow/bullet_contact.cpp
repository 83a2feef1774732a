// Bullet's contacts: the box detector, and GJK with EPA, followed by face clipping for hulls.

#include "bullet_convex.hpp"

#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPolyhedralContactClipping.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace abut::bench {

using namespace bullet;

void bullet::find_closest(const Pair& pair, Points& points) {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btGjkPairDetector(pair.a, pair.b, &simplex, &penetration).getClosestPoints(pair.input, points, nullptr);
}

namespace {

constexpr btScalar threshold = 0.02f;  // Bullet's default contact breaking threshold: it searches no farther

/// Finds the deepest point with `find`, then clips the faces there.
template <class Find>
Side contact_of_hulls(const scenes::ConvexPairs<3>& scene, Find find) {
    struct Scratch {
        btVertexArray vertices, more_vertices;
    };
    return side(
        scene,
        [find, scratch = std::make_shared<Scratch>()](const Pair& pair, std::size_t) {
            Points deepest, points;
            find(pair, deepest);
            if (deepest.depth_or_none() < 0) return -1.0;
            const auto* a = static_cast<const btPolyhedralConvexShape*>(pair.a)->getConvexPolyhedron();
            const auto* b = static_cast<const btPolyhedralConvexShape*>(pair.b)->getConvexPolyhedron();
            btPolyhedralContactClipping::clipHullAgainstHull(
                deepest.m_normalOnSurfaceB, *a, *b, pair.input.m_transformA, pair.input.m_transformB,
                deepest.m_distance - threshold, threshold, scratch->vertices, scratch->more_vertices, points);
            return deepest.depth_or_none();
        },
        threshold);
}

void find_deepest(const Pair& pair, Points& points) {
    const btTransform &a = pair.input.m_transformA, &b = pair.input.m_transformB;
    btGjkEpaSolver2::sResults found;
    if (btGjkEpaSolver2::Penetration(pair.a, a, pair.b, b, a.getOrigin() - b.getOrigin(), found))
        points.addContactPoint(-found.normal, found.witnesses[1], found.distance);
}

}  // namespace

Side bullet_contact(const scenes::ConvexPairs<3>& scene) {
    return side(
        scene,
        [](const Pair& pair, std::size_t) {
            Points points;
            find_closest(pair, points);
            return points.depth_or_none();
        },
        threshold);
}

Side bullet_contact_of_boxes(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [](const Pair& pair, std::size_t) {
        Points points;
        btBoxBoxDetector(static_cast<const btBoxShape*>(pair.a), static_cast<const btBoxShape*>(pair.b))
            .getClosestPoints(pair.input, points, nullptr);
        return points.depth_or_none();
    });
}

Side bullet_contact_of_hulls(const scenes::ConvexPairs<3>& scene) {
    return contact_of_hulls(scene, find_closest);
}

Side bullet_contact_of_hulls_by_epa(const scenes::ConvexPairs<3>& scene) {
    Side result = contact_of_hulls(scene, find_deepest);
    result.who = "bullet epa";
    return result;
}

}  // namespace abut::bench
