// Pairs of shapes: distances, decisions, contacts and rays, each pair from nothing.

#include "../scenes/convex_pairs.hpp"
#include "../scenes/terrain.hpp"
#include "bench.hpp"
#include "peers.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/segment.hpp>

#include <cmath>
#include <memory>
#include <utility>

namespace abut::bench {

namespace {

using scenes::ConvexPairs;

constexpr std::size_t pair_count = 1024;
constexpr std::size_t hull_count = 64;  // so many different ones
constexpr std::uint64_t seed = 1;

template <class S>
using PlacedShape = decltype(scenes::placed(std::declval<const S&>(), Pose3()));

/// The pairs of a scene whose shapes are all of type S, and the shapes they refer to.
template <class S>
struct OwnPairs {
    explicit OwnPairs(const ConvexPairs& from) : scene(from) {
        for (const auto& [a, b] : scene.pairs) pairs.emplace_back(own(a), own(b));
    }
    PlacedShape<S> own(const scenes::Placed& item) const {
        return scenes::placed(std::get<S>(scene.shapes[item.shape]), item.pose);
    }

    ConvexPairs scene;
    std::vector<std::pair<PlacedShape<S>, PlacedShape<S>>> pairs;
};

template <class S, class Question>
Side abut_side(const ConvexPairs& scene, Question question) {
    return {"abut", [own = std::make_shared<const OwnPairs<S>>(scene), question](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i)
                    values[i] = question(own->pairs[i].first, own->pairs[i].second);
            }};
}

template <class S>
Side abut_closest(const ConvexPairs& scene) {
    return abut_side<S>(scene, [](const auto& a, const auto& b) -> double { return closest(a, b).distance; });
}

template <class S>
Side abut_contact(const ConvexPairs& scene) {
    return abut_side<S>(scene, [](const auto& a, const auto& b) -> double {
        const Contact<3> found = contact(a, b);
        return found ? found.depth : -1;
    });
}

template <class Make>
auto many(std::size_t count, Make make) {
    std::vector<decltype(make())> result;
    while (result.size() < count) result.push_back(make());
    return result;
}

Job job(const ConvexPairs& scene, std::vector<Side> sides) {
    return {.items = scene.pairs.size(), .values = scene.pairs.size(), .sides = std::move(sides)};
}

std::vector<Polyhedron> hulls(oracle::Random& random) {
    return many(hull_count, [&] { return scenes::random_hull(random, 32); });
}

ConvexPairs box_pairs(double low, double high) {
    oracle::Random random(seed);
    const auto boxes = many(2 * pair_count, [&] { return scenes::random_box(random); });
    return scenes::random_pairs(boxes, pair_count, low, high, random);
}
ConvexPairs capsule_pairs(double low, double high) {
    oracle::Random random(seed);
    const auto capsules = many(2 * pair_count, [&] { return scenes::random_capsule(random); });
    return scenes::random_pairs(capsules, pair_count, low, high, random);
}
ConvexPairs hull_pairs(double low, double high) {
    oracle::Random random(seed);
    return scenes::random_pairs(hulls(random), pair_count, low, high, random);
}

Job closest_boxes() {
    const ConvexPairs scene = box_pairs(0.01, 1);
    return job(scene, {abut_closest<Box3>(scene), bullet_closest(scene), fcl_closest(scene)});
}
Job closest_hulls() {
    const ConvexPairs scene = hull_pairs(0.01, 1);
    return job(scene, {abut_closest<Polyhedron>(scene), bullet_closest(scene), fcl_closest(scene)});
}
Job closest_capsules() {
    const ConvexPairs scene = capsule_pairs(0.01, 1);
    return job(scene, {abut_closest<Capsule3>(scene), bullet_closest(scene), fcl_closest(scene)});
}

Job overlaps_boxes() {
    const ConvexPairs scene = box_pairs(-0.3, 0.3);
    const Side ours =
        abut_side<Box3>(scene, [](const auto& a, const auto& b) -> double { return overlaps(a, b) ? 1 : 0; });
    return job(scene, {ours, bullet_overlaps_of_boxes(scene), fcl_overlaps(scene)});
}

Job contact_boxes() {
    oracle::Random random(seed);
    const ConvexPairs scene = scenes::stacked_boxes(pair_count, random);
    return job(scene, {abut_contact<Box3>(scene), bullet_contact_of_boxes(scene), fcl_contact_of_boxes(scene)});
}
Job contact_hulls() {
    const ConvexPairs scene = hull_pairs(-0.03, -0.01);
    return job(scene, {abut_contact<Polyhedron>(scene), bullet_contact_of_hulls(scene), fcl_depth(scene)});
}

/// From without, towards points in and near the hull; rays that graze it are left out.
RayScene rays_at_hulls() {
    oracle::Random random(seed);
    RayScene scene;
    const std::vector<Polyhedron> all = hulls(random);
    scene.shapes.assign(all.begin(), all.end());
    while (scene.rays.size() < pair_count) {
        const scenes::Placed target{random.below(hull_count), {to_float<3>(random.in_cube<3>()), random.rotation<3>()}};
        const Vec3 from = target.pose.position + to_float<3>(random.direction<3>() * 4.0);
        const Vec3 through = target.pose.position + to_float<3>(random.in_cube<3>());
        const Vec3 to = from + 2.0f * (through - from);
        const float gap = closest(Segment3{from, to}, scenes::placed(all[target.shape], target.pose)).distance;
        if (std::abs(gap) < 0.01f) continue;
        scene.targets.push_back(target);
        scene.rays.push_back(Ray3::between(from, to));
    }
    return scene;
}

Job raycast_hulls() {
    const RayScene scene = rays_at_hulls();
    const Side ours{"abut", [scene = std::make_shared<const RayScene>(scene)](std::span<double> values) {
                        for (std::size_t i = 0; i < values.size(); ++i) {
                            const scenes::Placed& target = scene->targets[i];
                            const auto& hull = std::get<Polyhedron>(scene->shapes[target.shape]);
                            const auto hit = raycast(scene->rays[i], at(hull, target.pose));
                            values[i] = hit ? hit->distance : -1;
                        }
                    }};
    return {.items = pair_count, .values = pair_count, .sides = {ours, bullet_raycast(scene)}};
}

/// Hulls above a terrain of 20,000 triangles, as high as a walker's foot or a flying thing.
MeshScene hulls_above_terrain() {
    oracle::Random random(seed);
    MeshScene scene{scenes::random_terrain(100, random), {}, {}};
    const std::vector<Polyhedron> all = hulls(random);
    scene.shapes.assign(all.begin(), all.end());
    while (scene.placed.size() < pair_count)
        scene.placed.push_back(
            {random.below(hull_count),
             {{random.uniform_float(-45, 45), random.uniform_float(1.6, 3), random.uniform_float(-45, 45)},
              random.rotation<3>()}});
    return scene;
}

Job closest_to_mesh() {
    const MeshScene scene = hulls_above_terrain();
    const auto mesh = std::make_shared<const Mesh>(*Mesh::build(scene.terrain.points, scene.terrain.triangles));
    const Side ours{"abut", [scene = std::make_shared<const MeshScene>(scene), mesh](std::span<double> values) {
                        for (std::size_t i = 0; i < values.size(); ++i) {
                            const scenes::Placed& item = scene->placed[i];
                            const auto& hull = std::get<Polyhedron>(scene->shapes[item.shape]);
                            values[i] = closest(at(hull, item.pose), *mesh).distance;
                        }
                    }};
    return {.items = pair_count, .values = pair_count, .sides = {ours, fcl_closest_to_mesh(scene)}};
}

}  // namespace

std::vector<Bench> narrow_benches() {
    return {
        {"narrow/closest/box-box", closest_boxes},
        {"narrow/closest/hull32-hull32", closest_hulls},
        {"narrow/closest/capsule-capsule", closest_capsules},
        {"narrow/closest/hull32-mesh20k", closest_to_mesh},
        {"narrow/overlaps/box-box", overlaps_boxes},
        {"narrow/contact/box-box", contact_boxes},
        {"narrow/contact/hull32-hull32", contact_hulls},
        {"narrow/raycast/hull32", raycast_hulls},
    };
}

}  // namespace abut::bench
