// Ray casts against single shapes.

#include "narrow.hpp"
#include <abut/query/raycast.hpp>
#include <abut/shape/segment.hpp>

#include <cmath>

namespace abut::bench {

using namespace detail;

namespace {

// Bullet's cast stops slightly before round shapes, and hits a few that it should miss. Closed forms in double, and the
// planes of hulls, confirm abut's values.

/// Rays from outside to points in and near the shape; grazing rays are left out.
template <class S>
RayScene<dimension<S>> rays_at(const Kind<S>& kind, std::size_t count = pair_count) {
    constexpr int D = dimension<S>;
    oracle::Random random(seed);
    RayScene<D> scene;
    const std::vector<S> all = drawn(kind, random);
    scene.shapes.assign(all.begin(), all.end());
    while (scene.rays.size() < count) {
        const scenes::Placed<D> target{random.below(static_cast<std::uint32_t>(kind.count)),
                                       {to_float<D>(random.in_cube<D>()), random.rotation<D>()}};
        const Vec<D> from = target.pose.position + to_float<D>(random.direction<D>() * 4.0);
        const Vec<D> through = target.pose.position + to_float<D>(random.in_cube<D>());
        const Vec<D> to = from + 2.0f * (through - from);
        const float gap = closest(Segment<D>{from, to}, scenes::placed(all[target.shape], target.pose)).distance;
        if (std::abs(gap) < 0.01f) continue;
        scene.targets.push_back(target);
        scene.rays.push_back(Ray<D>::between(from, to));
    }
    return scene;
}

template <class S>
struct OwnRays {
    struct Cast {
        Ray<dimension<S>> ray;
        PlacedShape<S> target;
    };
    explicit OwnRays(const RayScene<dimension<S>>& from) : scene(from) {
        for (std::size_t i = 0; i < scene.rays.size(); ++i)
            casts.push_back({scene.rays[i],
                             scenes::placed(std::get<S>(scene.shapes[scene.targets[i].shape]), scene.targets[i].pose)});
    }

    RayScene<dimension<S>> scene;
    std::vector<Cast> casts;
};

template <class S>
Side abut_raycast(const RayScene<dimension<S>>& scene) {
    return {"abut", [own = std::make_shared<const OwnRays<S>>(scene)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) {
                    const auto hit = raycast(own->casts[i].ray, own->casts[i].target);
                    values[i] = hit ? hit->distance : -1;
                }
            }};
}

Job job(std::vector<Side> sides, std::size_t count = pair_count) {
    return {.items = count, .values = count, .sides = std::move(sides)};
}

Job rays_at_spheres() {
    const RayScene<3> scene = rays_at(spheres);
    return job({abut_raycast<Sphere>(scene), straying(bullet_raycast(scene), 0.05)});
}
Job rays_at_boxes() {
    const RayScene<3> scene = rays_at(boxes<3>);
    return job({abut_raycast<Box3>(scene), straying(bullet_raycast(scene), 0.01)});
}
Job rays_at_capsules() {
    const RayScene<3> scene = rays_at(capsules);
    return job({abut_raycast<Capsule3>(scene), straying(bullet_raycast(scene), 0.2),
                straying(bullet_raycast_by_gjk(scene), 0.03)});
}
Job rays_at_hulls() {
    const RayScene<3> scene = rays_at(hulls<32>);
    return job({abut_raycast<Polyhedron>(scene), straying(bullet_raycast(scene), 0.01)});
}
template <class S>
Job rays_in_plane(const Kind<S>& kind, std::size_t count = pair_count) {
    const RayScene<2> scene = rays_at(kind, count);
    return job({abut_raycast<S>(scene), box2d_raycast(scene)}, count);
}

}  // namespace

std::vector<Bench> raycast_benches() {
    return {
        {"narrow/raycast/sphere", rays_at_spheres},
        {"narrow/raycast/box", rays_at_boxes},
        {"narrow/raycast/capsule", rays_at_capsules},
        {"narrow/raycast/hull32", rays_at_hulls},
        {"narrow/raycast/circle", [] { return rays_in_plane(circles); }},
        {"narrow/raycast/polygon3-8", [] { return rays_in_plane(polygons); }},
        {"narrow/raycast/circle-many", [] { return rays_in_plane(circles, many); }},
        {"narrow/raycast/polygon3-8-many", [] { return rays_in_plane(polygons, many); }},
    };
}

}  // namespace abut::bench
