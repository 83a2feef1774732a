// A box and a capsule at a terrain of a hundred thousand triangles: does it touch anything? Half of them do.

#include "levels.hpp"

#include "../scenes/terrain.hpp"
#include <abut/query/overlaps.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>

namespace abut::bench {

namespace {

constexpr std::size_t query_count = 8192;
constexpr std::uint32_t columns = 224;
constexpr std::uint64_t seed = 1;

/// The peers calculate with tolerances, Bullet in floats: of what just touches or just doesn't, some say otherwise.
constexpr double few = 0.01;

SharedLevelScene scene_of(const std::variant<Box3, Capsule3>& shape) {
    oracle::Random random(seed);
    scenes::Terrain ground = scenes::random_terrain(columns, random);
    auto result =
        std::make_shared<LevelScene>(LevelScene{std::move(ground.points), std::move(ground.triangles), shape, {}});
    const double half = 0.49 * columns;
    for (std::size_t i = 0; i < query_count; ++i) {
        const float x = random.uniform_float(-half, half), y = random.uniform_float(-0.5, 2.5);
        result->poses.push_back({{x, y, random.uniform_float(-half, half)}, random.rotation<3>()});
    }
    return result;
}

Job overlaps_at_all(const SharedLevelScene& scene) {
    const Side ours{"abut", [scene, mesh = *Mesh::build(scene->points, scene->triangles)](std::span<double> values) {
                        const auto ask = [&](const auto& shape) {
                            for (std::size_t i = 0; i < values.size(); ++i)
                                values[i] = overlaps(at(shape, scene->poses[i]), mesh) ? 1 : 0;
                        };
                        std::visit(ask, scene->shape);
                    }};
    Side bullet = bullet_level_overlaps(scene), fcl = fcl_level_overlaps(scene);
    bullet.strays = fcl.strays = few;
    return {.items = query_count, .values = query_count, .sides = {ours, bullet, fcl}};
}

}  // namespace

std::vector<Bench> level_benches() {
    return {
        {"levels/overlaps/terrain/100k/box",
         [] {
             return overlaps_at_all(scene_of(Box3{{0, 0, 0}, {1, 0.75f, 0.5f}}));
         }},
        {"levels/overlaps/terrain/100k/capsule",
         [] {
             return overlaps_at_all(scene_of(Capsule3{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.5f}));
         }},
    };
}

}  // namespace abut::bench
