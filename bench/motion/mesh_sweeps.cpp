// Linear sweeps of a ball, a capsule and a box at a large mesh, most of them far and just above the ground.

#include "mesh_sweeps.hpp"

#include <abut/query/sweep.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>

namespace abut::bench {

using namespace detail;

namespace {

// Bullet stops early at flat angles, where a small error across the ground is a large one along the motion.
constexpr double tolerance = 0.05, few = 0.1;

Job sweeps_at_mesh(const SweptShape& shape) {
    const MeshSweeps sweeps{terrain_rays(224), shape};
    const auto& scene = sweeps.scene;
    const Side ours{
        "abut", [sweeps, mesh = *Mesh::build(scene->points, scene->triangles)](std::span<double> values) {
            std::visit(
                [&]<class S>(const S& swept) {
                    for (std::size_t i = 0; i < values.size(); ++i) {
                        const Ray3& ray = sweeps.scene->rays[i];
                        const auto hit = sweep(at(swept, Pose3{ray.origin, {}}), ray.direction * ray.length, mesh);
                        values[i] = hit ? static_cast<double>(hit->distance) : -1.0;
                    }
                },
                sweeps.shape);
        }};
    Side peer = bullet_mesh_sweeps(sweeps);
    peer.strays = few;
    return {.items = scene->rays.size(), .values = scene->rays.size(), .tolerance = tolerance, .sides = {ours, peer}};
}

}  // namespace

std::vector<Bench> mesh_sweep_benches() {
    constexpr float radius = 0.25f;
    return {
        {"motion/sweep/mesh/ball",
         [] {
             return sweeps_at_mesh(Sphere{Vec3(0), radius});
         }},
        {"motion/sweep/mesh/capsule",
         [] {
             return sweeps_at_mesh(Capsule3{Vec3(0, -radius, 0), Vec3(0, radius, 0), radius});
         }},
        {"motion/sweep/mesh/box",
         [] {
             return sweeps_at_mesh(Box3{Vec3(0), Vec3(radius)});
         }},
    };
}

}  // namespace abut::bench
