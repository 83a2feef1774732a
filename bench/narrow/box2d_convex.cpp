// Box2D's narrow phase: b2Distance, manifolds of polygons and circles, and ray casts. Polygons without their default
// radius.

#include "../each_pair.hpp"
#include "../peers.hpp"
#include "box2d_shape.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include <box2d/b2_collision.h>
#include <box2d/b2_distance.h>

namespace abut::bench {

namespace {

struct Pair {
    const b2Shape* a;
    const b2Shape* b;
    b2DistanceInput input;  ///< contains the poses
};

struct Scene {
    explicit Scene(const scenes::ConvexPairs<2>& scene) : shapes(box2d::shapes_of(scene.shapes)) {
        for (const auto& [a, b] : scene.pairs) {
            Pair& pair = pairs.emplace_back();
            pair.a = shapes[a.shape].get();
            pair.b = shapes[b.shape].get();
            pair.input.proxyA.Set(pair.a, 0);
            pair.input.proxyB.Set(pair.b, 0);
            pair.input.transformA = to_box2d(a.pose);
            pair.input.transformB = to_box2d(b.pose);
            pair.input.useRadii = false;
        }
    }

    std::vector<std::unique_ptr<b2Shape>> shapes;
    std::vector<Pair> pairs;
};

template <class Question>
Side side(const scenes::ConvexPairs<2>& scene, Question question) {
    return {"box2d", each_pair(std::make_shared<const Scene>(scene), std::move(question))};
}

/// Points are transformed to world space, as abut's are: Box2D has no other depth.
double depth_of(const b2Manifold& manifold, const Pair& pair) {
    if (manifold.pointCount == 0) return -1;
    b2WorldManifold world;
    world.Initialize(&manifold, pair.input.transformA, pair.a->m_radius, pair.input.transformB, pair.b->m_radius);
    const float deepest = *std::min_element(world.separations, world.separations + manifold.pointCount);
    return deepest <= 0 ? -double{deepest} : -1;
}

}  // namespace

Side box2d_closest(const scenes::ConvexPairs<2>& scene, Frames frames) {
    const bool keep = frames == Frames::coherent;
    return side(scene, [keep, caches = std::vector<b2SimplexCache>(scene.count())](const Pair& pair,
                                                                                   std::size_t place) mutable {
        b2SimplexCache& cache = caches[place];
        if (!keep) cache.count = 0;
        b2DistanceOutput output;
        b2Distance(&output, &cache, &pair.input);
        return double{output.distance};
    });
}

Side box2d_overlaps(const scenes::ConvexPairs<2>& scene) {
    return side(scene, [](const Pair& pair, std::size_t) -> double {
        return b2TestOverlap(pair.a, 0, pair.b, 0, pair.input.transformA, pair.input.transformB) ? 1 : 0;
    });
}

Side box2d_contact_of_polygons(const scenes::ConvexPairs<2>& scene) {
    return side(scene, [](const Pair& pair, std::size_t) {
        b2Manifold manifold;
        b2CollidePolygons(&manifold, static_cast<const b2PolygonShape*>(pair.a), pair.input.transformA,
                          static_cast<const b2PolygonShape*>(pair.b), pair.input.transformB);
        return depth_of(manifold, pair);
    });
}

Side box2d_contact_of_polygon_and_circle(const scenes::ConvexPairs<2>& scene) {
    return side(scene, [](const Pair& pair, std::size_t) {
        b2Manifold manifold;
        b2CollidePolygonAndCircle(&manifold, static_cast<const b2PolygonShape*>(pair.a), pair.input.transformA,
                                  static_cast<const b2CircleShape*>(pair.b), pair.input.transformB);
        return depth_of(manifold, pair);
    });
}

Side box2d_raycast(const RayScene<2>& scene) {
    struct Cast {
        const b2Shape* shape;
        b2Transform pose;
        b2RayCastInput input;
        double length;
    };
    struct Casts {
        std::vector<std::unique_ptr<b2Shape>> shapes;
        std::vector<Cast> casts;
    };
    const auto all = std::make_shared<Casts>(Casts{box2d::shapes_of(scene.shapes), {}});
    for (std::size_t i = 0; i < scene.rays.size(); ++i) {
        const Ray2& ray = scene.rays[i];
        all->casts.push_back(
            {all->shapes[scene.targets[i].shape].get(), to_box2d(scene.targets[i].pose),
             b2RayCastInput{to_box2d(ray.origin), to_box2d(ray.origin + ray.length * ray.direction), 1}, ray.length});
    }
    return {"box2d", [all](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) {
                    const Cast& cast = all->casts[i];
                    b2RayCastOutput output;
                    const bool hit = cast.shape->RayCast(&output, cast.input, cast.pose, 0);
                    values[i] = hit ? double{output.fraction} * cast.length : -1;
                }
            }};
}

}  // namespace abut::bench
