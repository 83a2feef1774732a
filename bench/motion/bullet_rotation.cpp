// Bullet's conservative advancement of two shapes that translate and rotate.

#include "../narrow/bullet_convex.hpp"
#include "rotation.hpp"

#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace abut::bench {

namespace {

struct Moving {
    std::unique_ptr<btConvexShape> shape;
    btTransform from, to;

    explicit Moving(const RotatingBox<3>& moving)
        : shape(bullet::shape_of(moving.box)), from(to_bullet(moving.from)), to(to_bullet(moving.to)) {}
};
struct Pair {
    Moving a, b;
};
struct Scene {
    std::vector<Pair> pairs;
};

}  // namespace

Side bullet_rotation(const RotationScene<3>& scene) {
    auto own = std::make_shared<Scene>();
    for (const auto& [a, b] : scene.pairs) own->pairs.push_back({Moving(a), Moving(b)});
    return {"bullet", each_pair(std::shared_ptr<const Scene>(own), [](const Pair& pair, std::size_t) {
                btVoronoiSimplexSolver simplex;
                btGjkEpaPenetrationDepthSolver penetration;
                btConvexCast::CastResult result;
                btContinuousConvexCollision cast(pair.a.shape.get(), pair.b.shape.get(), &simplex, &penetration);
                const bool collides = cast.calcTimeOfImpact(pair.a.from, pair.a.to, pair.b.from, pair.b.to, result);
                return collides ? double{result.m_fraction} : no_impact;
            })};
}

}  // namespace abut::bench
