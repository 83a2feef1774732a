// Bullet's three algorithms for a linear sweep of convex shapes.

#include "../narrow/bullet_convex.hpp"
#include "linear.hpp"

#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace abut::bench {

namespace {

struct Moving {
    const btConvexShape *a, *b;
    btTransform from, to, there;
    double length;
};
struct Scene {
    explicit Scene(const LinearScene<3>& scene) : shapes(scene.pairs) {
        for (std::size_t i = 0; i < scene.motions.size(); ++i) {
            const auto& [a, b, input] = shapes.pairs[i];
            const btVector3 motion = to_bullet(scene.motions[i]);
            const btTransform to(input.m_transformA.getBasis(), input.m_transformA.getOrigin() + motion);
            pairs.push_back({a, b, input.m_transformA, to, input.m_transformB, double{motion.length()}});
        }
    }

    bullet::Scene shapes;
    std::vector<Moving> pairs;
};

template <class MakeCast>
Side cast_shapes(std::string who, const LinearScene<3>& scene, const MakeCast& make_cast) {
    return {std::move(who),
            each_pair(std::make_shared<const Scene>(scene), [make_cast](const Moving& pair, std::size_t) {
                btVoronoiSimplexSolver simplex;
                // Squared tolerance, default 1e-4: they would stop 0.01 early.
                simplex.setEqualVertexThreshold(1e-10f);
                btConvexCast::CastResult result;
                result.m_subSimplexCastEpsilon = 1e-7f;
                result.m_allowedPenetration = 0;
                auto cast = make_cast(pair, simplex);
                const bool hit = cast.calcTimeOfImpact(pair.from, pair.to, pair.there, pair.there, result);
                return hit && result.m_fraction <= 1 ? double{result.m_fraction} * pair.length : no_touch;
            })};
}

}  // namespace

Side bullet_linear(const LinearScene<3>& scene) {
    return cast_shapes("bullet", scene, [](const Moving& pair, btVoronoiSimplexSolver& simplex) {
        static btGjkEpaPenetrationDepthSolver penetration;
        return btContinuousConvexCollision(pair.a, pair.b, &simplex, &penetration);
    });
}
Side bullet_linear_by_simplex(const LinearScene<3>& scene) {
    return cast_shapes("bullet simplex", scene, [](const Moving& pair, btVoronoiSimplexSolver& simplex) {
        return btSubsimplexConvexCast(pair.a, pair.b, &simplex);
    });
}
Side bullet_linear_by_gjk(const LinearScene<3>& scene) {
    return cast_shapes("bullet gjk", scene, [](const Moving& pair, btVoronoiSimplexSolver& simplex) {
        return btGjkConvexCast(pair.a, pair.b, &simplex);
    });
}

}  // namespace abut::bench
