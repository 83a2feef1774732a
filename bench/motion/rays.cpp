// First hits, and any hits, of incoherent rays on meshes of different kinds: a scan, closed and finely rough; a
// terrain; and a large mesh. Also tree builds.

#include "rays.hpp"

#include "../../scenes/bumpy_ball.hpp"
#include "../../scenes/terrain.hpp"
#include <abut/query/raycast.hpp>
#include <abut/shape/mesh.hpp>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::size_t ray_count = 16384;
constexpr std::uint64_t seed = 1;

// Tolerance for distant hits, and for rays at edges, which libraries assign to different sides.
constexpr double tolerance = 1e-3, few = 1e-3;

/// Embree reads sixteen bytes of each point, including the last.
void reserve_for_embree(RayMesh& mesh) {
    mesh.points.reserve(mesh.points.size() + 2);
}

/// Rays around a stone of radius 1, from all directions to points in and around it.
SharedRayMesh scan() {
    oracle::Random random(seed);
    scenes::BumpyBall ball = scenes::bumpy_ball(147, 0.2, 0.001, random);
    auto result = std::make_shared<RayMesh>(RayMesh{std::move(ball.points), std::move(ball.triangles), {}});
    reserve_for_embree(*result);
    for (std::size_t i = 0; i < ray_count; ++i) {
        Ray3 ray = Ray3::between(to_float(random.direction<3>() * 2.0), to_float(random.in_cube<3>() * 0.9));
        ray.length = 10;
        result->rays.push_back(ray);
    }
    return result;
}

Side straying(Side side) {
    side.strays = few;
    return side;
}

Job rays(const SharedRayMesh& scene) {
    const Side ours{"abut", [scene, mesh = *Mesh::build(scene->points, scene->triangles)](std::span<double> values) {
                        for (std::size_t i = 0; i < values.size(); ++i) {
                            const auto hit = raycast(scene->rays[i], mesh);
                            values[i] = hit ? static_cast<double>(hit->distance) : -1.0;
                        }
                    }};
    return {.items = ray_count,
            .values = ray_count,
            .tolerance = tolerance,
            .sides = {ours, straying(embree_rays(scene, Quality::usual, Edges::fast)),
                      straying(embree_rays(scene, Quality::usual, Edges::robust)),
                      straying(embree_rays(scene, Quality::high, Edges::fast)),
                      straying(embree_rays(scene, Quality::high, Edges::robust)), straying(bullet_rays(scene))}};
}

Job any_hits(const SharedRayMesh& scene) {
    const Side ours{"abut", [scene, mesh = *Mesh::build(scene->points, scene->triangles)](std::span<double> values) {
                        for (std::size_t i = 0; i < values.size(); ++i)
                            values[i] = raycast_any(scene->rays[i], mesh) ? 1 : 0;
                    }};
    return {.items = ray_count,
            .values = ray_count,
            .tolerance = tolerance,
            .sides = {ours, straying(embree_any_hits(scene, Edges::fast)),
                      straying(embree_any_hits(scene, Edges::robust))}};
}

Job build(const SharedRayMesh& scene) {
    const Side ours{"abut", [scene](std::span<double> values) {
                        const Mesh mesh = *Mesh::build(scene->points, scene->triangles);
                        const auto hit = raycast(scene->rays[0], mesh);
                        values[0] = hit ? static_cast<double>(hit->distance) : -1.0;
                    }};
    return {.items = scene->triangles.size(),
            .values = 1,
            .tolerance = tolerance,
            .sides = {ours, embree_mesh_build(scene, Quality::usual), embree_mesh_build(scene, Quality::high),
                      bullet_mesh_build(scene)}};
}

}  // namespace

SharedRayMesh terrain_rays(std::uint32_t columns) {
    oracle::Random random(seed);
    scenes::Terrain ground = scenes::random_terrain(columns, random);
    auto result = std::make_shared<RayMesh>(RayMesh{std::move(ground.points), std::move(ground.triangles), {}});
    reserve_for_embree(*result);
    const double half = 0.5 * columns;
    const auto place = [&](double low, double high) {
        const float x = random.uniform_float(-half, half), y = random.uniform_float(low, high);
        return Vec3(x, y, random.uniform_float(-half, half));
    };
    for (std::size_t i = 0; i < ray_count; ++i) {
        const Vec3 from = place(0.6, 0.1 * half);
        Ray3 ray = Ray3::between(from, place(-0.5, 0.5));
        ray.length = static_cast<float>(columns) * 2;
        result->rays.push_back(ray);
    }
    return result;
}

std::vector<Bench> ray_benches() {
    return {
        {"motion/rays/scan/86k", [] { return rays(scan()); }},
        {"motion/rays/terrain/100k", [] { return rays(terrain_rays(224)); }},
        {"motion/rays/terrain/1M", [] { return rays(terrain_rays(707)); }},
        {"motion/rays/any/scan/86k", [] { return any_hits(scan()); }},
        {"motion/rays/any/terrain/100k", [] { return any_hits(terrain_rays(224)); }},
        {"motion/rays/any/terrain/1M", [] { return any_hits(terrain_rays(707)); }},
        {"motion/rays/build/scan/86k", [] { return build(scan()); }},
        {"motion/rays/build/terrain/100k", [] { return build(terrain_rays(224)); }},
        {"motion/rays/build/terrain/1M", [] { return build(terrain_rays(707)); }},
    };
}

}  // namespace abut::bench
