// Distances: pairs in 3D, and hulls above a terrain.

#include "../upper_halves.hpp"
#include "narrow.hpp"
#include <abut/shape/mesh.hpp>

namespace abut::bench {

namespace {

constexpr Gaps apart{0.01, 1}, mixed{-0.3, 0.5};

// The faster of Bullet's two GJKs stops too early in a few of a thousand pairs, and either is off for some large hulls:
// abut's distances carry certificates (certify), and its depths equal the oracle's.
constexpr double few = 0.01, some = 0.02;

template <class A, class B>
Job apart_with(const ConvexPairs<3>& scene, Frames frames) {
    return job(scene, {abut_closest<A, B>(scene), straying(bullet_closest(scene), some),
                       straying(bullet_gap(scene, frames), few), straying(fcl_closest(scene), few)});
}
template <class A, class B>
Job closest_apart(const Kind<A>& a, const Kind<B>& b) {
    return apart_with<A, B>(resting(a, b, apart), Frames::unlike);
}
template <class A, class B>
Job closest_coherent(const Kind<A>& a, const Kind<B>& b) {
    return apart_with<A, B>(moving(a, b, always_apart), Frames::coherent);
}
template <class A, class B>
Job closest_mixed(const Kind<A>& a, const Kind<B>& b) {
    const ConvexPairs<3> scene = resting(a, b, mixed);
    return job(scene, {abut_closest<A, B>(scene), straying(bullet_closest(scene), some),
                       straying(fcl_signed_closest(scene), few)});
}

// Pairs for which Bullet and FCL have closed forms.

Job capsules_at(const Gaps& gaps, std::size_t count = pair_count) {
    const ConvexPairs<3> scene = resting(capsules, capsules, gaps, count);
    return job(scene, {abut_closest<Capsule3, Capsule3>(scene), bullet_closest_of_capsules(scene), fcl_closest(scene)});
}
Job sphere_and_box_apart(std::size_t count = pair_count) {
    const ConvexPairs<3> scene = resting(spheres, boxes<3>, apart, count);
    return job(scene, {abut_closest<Sphere, Box3>(scene), bullet_closest_of_sphere_and_box(scene), fcl_closest(scene)});
}
Job sphere_and_box_mixed(std::size_t count = pair_count) {
    const ConvexPairs<3> scene = resting(spheres, boxes<3>, mixed, count);
    std::vector<Side> sides{abut_closest<Sphere, Box3>(scene), bullet_closest_of_sphere_and_box(scene)};
    // FCL takes 0.05 ms where EPA must approximate a round shape.
    if (count == pair_count) sides.push_back(straying(fcl_signed_closest(scene), few));
    return job(scene, std::move(sides));
}

/// A caller that leaves the upper halves of vector registers dirty, compared with one that doesn't.
Job sphere_and_box_dirty() {
    const ConvexPairs<3> scene = resting(spheres, boxes<3>, apart);
    const auto in_use = [](const Sphere& a, const Box3& b, const QueryOptions<3>&) -> double {
        return distance_with_upper_halves_in_use(a, b);
    };
    const auto cleared = [](const Sphere& a, const Box3& b, const QueryOptions<3>&) -> double {
        return distance_with_upper_halves_cleared(a, b);
    };
    Side other = abut_side<Sphere, Box3>(scene, cleared);
    other.who = "abut, upper halves clear";
    return job(scene, {abut_side<Sphere, Box3>(scene, in_use), other});
}

/// Hulls above a terrain of 20,000 triangles, at the height of a walker's lower end or of a flying object.
MeshScene hulls_above_terrain() {
    oracle::Random random(seed);
    MeshScene scene{scenes::random_terrain(100, random), {}, {}};
    const std::vector<Polyhedron> all = drawn(hulls<32>, random);
    scene.shapes.assign(all.begin(), all.end());
    while (scene.placed.size() < pair_count)
        scene.placed.push_back(
            {random.below(hull_count),
             {{random.uniform_float(-45, 45), random.uniform_float(1.6, 3), random.uniform_float(-45, 45)},
              random.rotation<3>()}});
    return scene;
}

Job hulls_and_mesh() {
    const MeshScene scene = hulls_above_terrain();
    const auto mesh = std::make_shared<const Mesh>(*Mesh::build(scene.terrain.points, scene.terrain.triangles));
    const Side ours{"abut", [scene = std::make_shared<const MeshScene>(scene), mesh](std::span<double> values) {
                        for (std::size_t i = 0; i < values.size(); ++i) {
                            const scenes::Placed<3>& item = scene->placed[i];
                            const auto& hull = std::get<Polyhedron>(scene->shapes[item.shape]);
                            values[i] = closest(at(hull, item.pose), *mesh).distance;
                        }
                    }};
    return {.items = pair_count, .values = pair_count, .sides = {ours, fcl_closest_to_mesh(scene)}};
}

}  // namespace

std::vector<Bench> closest_benches() {
    return {
        {"narrow/closest/box-box/apart", [] { return closest_apart(boxes<3>, boxes<3>); }},
        {"narrow/closest/box-box/mixed", [] { return closest_mixed(boxes<3>, boxes<3>); }},
        {"narrow/closest/box-box/coherent", [] { return closest_coherent(boxes<3>, boxes<3>); }},
        {"narrow/closest/hull32-hull32/apart", [] { return closest_apart(hulls<32>, hulls<32>); }},
        {"narrow/closest/hull32-hull32/mixed", [] { return closest_mixed(hulls<32>, hulls<32>); }},
        {"narrow/closest/hull32-hull32/coherent", [] { return closest_coherent(hulls<32>, hulls<32>); }},
        {"narrow/closest/hull256-hull256/apart", [] { return closest_apart(hulls<256>, hulls<256>); }},
        {"narrow/closest/hull256-hull256/mixed", [] { return closest_mixed(hulls<256>, hulls<256>); }},
        {"narrow/closest/hull256-hull256/coherent", [] { return closest_coherent(hulls<256>, hulls<256>); }},
        {"narrow/closest/capsule-capsule/apart", [] { return capsules_at(apart); }},
        {"narrow/closest/capsule-capsule/mixed", [] { return capsules_at(mixed); }},
        {"narrow/closest/capsule-capsule/apart-many", [] { return capsules_at(apart, many); }},
        {"narrow/closest/capsule-capsule/mixed-many", [] { return capsules_at(mixed, many); }},
        {"narrow/closest/sphere-box/apart", [] { return sphere_and_box_apart(); }},
        {"narrow/closest/sphere-box/dirty", sphere_and_box_dirty},
        {"narrow/closest/sphere-box/mixed", [] { return sphere_and_box_mixed(); }},
        {"narrow/closest/sphere-box/apart-many", [] { return sphere_and_box_apart(many); }},
        {"narrow/closest/sphere-box/mixed-many", [] { return sphere_and_box_mixed(many); }},
        {"narrow/closest/capsule-box/apart", [] { return closest_apart(capsules, boxes<3>); }},
        {"narrow/closest/capsule-box/mixed", [] { return closest_mixed(capsules, boxes<3>); }},
        {"narrow/closest/hull32-mesh20k", hulls_and_mesh},
    };
}

}  // namespace abut::bench
