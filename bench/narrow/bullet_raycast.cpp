// Bullet's ray casts: convex casts of a point, as in btCollisionWorld.

#include "bullet_convex.hpp"

#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace abut::bench {

namespace {

struct Rays {
    struct Ray {
        const btConvexShape* shape;
        btTransform pose, from, to;
        double length;
    };

    explicit Rays(const RayScene<3>& from) : scene(from.shapes) {
        const auto at = [](const Vec3& point) { return btTransform(btQuaternion::getIdentity(), to_bullet(point)); };
        for (std::size_t i = 0; i < from.rays.size(); ++i) {
            const Ray3& ray = from.rays[i];
            const scenes::Placed<3>& target = from.targets[i];
            rays.push_back({scene.shapes[target.shape].get(), to_bullet(target.pose), at(ray.origin),
                            at(ray.origin + ray.length * ray.direction), ray.length});
        }
    }

    bullet::Scene scene;
    std::vector<Ray> rays;
};

template <class Cast>
Side cast_rays(std::string who, const RayScene<3>& scene) {
    const auto run = [all = std::make_shared<const Rays>(scene)](std::span<double> values) {
        btSphereShape point(0);
        point.setMargin(0);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const Rays::Ray& ray = all->rays[i];
            btVoronoiSimplexSolver simplex;
            btConvexCast::CastResult result;
            // Squared tolerance, default 1e-4: the cast would stop 0.01 before the hull.
            result.m_subSimplexCastEpsilon = 1e-7f;
            simplex.setEqualVertexThreshold(1e-10f);
            const bool hit =
                Cast(&point, ray.shape, &simplex).calcTimeOfImpact(ray.from, ray.to, ray.pose, ray.pose, result);
            // The acceptance test of btCollisionWorld::rayTestSingle.
            const bool counts = hit && result.m_normal.length2() > 0.0001f && result.m_fraction < 1;
            values[i] = counts ? double{result.m_fraction} * ray.length : -1;
        }
    };
    return {std::move(who), run};
}

}  // namespace

Side bullet_raycast(const RayScene<3>& scene) {
    return cast_rays<btSubsimplexConvexCast>("bullet", scene);
}

Side bullet_raycast_by_gjk(const RayScene<3>& scene) {
    return cast_rays<btGjkConvexCast>("bullet gjk", scene);
}

}  // namespace abut::bench
