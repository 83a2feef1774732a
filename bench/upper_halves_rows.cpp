// Small calls of the library by a caller that leaves the upper halves of vector registers in use. Each row compares two
// calls that are equal but for this.

#include "../scenes/moving_boxes.hpp"
#include "../scenes/terrain.hpp"
#include "upper_halves.hpp"
#include "walk/walk.hpp"
#include <abut/broad_phase/bvh.hpp>
#include <abut/field/field.hpp>
#include <abut/motion/laser.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/polygon.hpp>

#include <array>
#include <memory>
#include <utility>

namespace abut::bench {

#if defined(__x86_64__) && defined(__GNUC__)
void use_upper_halves() {
    if (__builtin_cpu_supports("avx2")) asm volatile("vpcmpeqd %%ymm15, %%ymm15, %%ymm15" ::: "xmm15");
}
void use_and_clear_upper_halves() {
    use_upper_halves();
    if (__builtin_cpu_supports("avx2")) asm volatile("vzeroupper");
}
#else
void use_upper_halves() {}
void use_and_clear_upper_halves() {}
#endif

namespace {

constexpr std::size_t calls = 1024;
constexpr std::uint64_t seed = 1;

/// `call(i)` is one call of the library, and returns a number.
template <class Call>
Job dirty_and_clear(const Call& call) {
    const Side dirty{"abut", [call](std::span<double> values) {
                         for (std::size_t i = 0; i < values.size(); ++i) {
                             use_upper_halves();
                             values[i] = call(i);
                         }
                     }};
    const Side clear{"abut, upper halves clear", [call](std::span<double> values) {
                         for (std::size_t i = 0; i < values.size(); ++i) {
                             use_and_clear_upper_halves();
                             values[i] = call(i);
                         }
                     }};
    return {.items = calls, .values = calls, .sides = {dirty, clear}};
}

Job broad_phase(std::size_t count, bool all) {
    scenes::MovingBoxes<3> scene(count, seed);
    const auto before = std::make_shared<const std::vector<Aabb3>>(scene.boxes().begin(), scene.boxes().end());
    scene.step();
    const auto after = std::make_shared<const std::vector<Aabb3>>(scene.boxes().begin(), scene.boxes().end());
    const auto tree = std::make_shared<Bvh<3>>();
    tree->build(*before);
    return dirty_and_clear([=](std::size_t i) {
        const std::vector<Aabb3>& boxes = i % 2 == 0 ? *after : *before;
        if (all)
            tree->update(boxes);
        else
            tree->set(static_cast<std::uint32_t>(i % boxes.size()), boxes[i % boxes.size()]);
        return 0.0;
    });
}

Job ray_and_mesh() {
    oracle::Random random(seed);
    const scenes::Terrain terrain = scenes::random_terrain(100, random);
    const auto mesh = std::make_shared<const Mesh>(*Mesh::build(terrain.points, terrain.triangles));
    std::vector<Ray3> rays;
    while (rays.size() < calls)
        rays.push_back({{random.uniform_float(-45, 45), 2, random.uniform_float(-45, 45)}, {0, -1, 0}, 4});
    return dirty_and_clear([mesh, rays](std::size_t i) {
        const std::optional<Hit<3>> hit = raycast(rays[i], *mesh);
        return hit ? static_cast<double>(hit->distance) : -1.0;
    });
}

Job polygon() {
    oracle::Random random(seed);
    std::vector<std::array<Vec2, 8>> points(calls);
    for (std::array<Vec2, 8>& loop : points)
        for (Vec2& point : loop) point = {random.uniform_float(-1, 1), random.uniform_float(-1, 1)};
    return dirty_and_clear(
        [points](std::size_t i) { return static_cast<double>(Polygon::build(points[i])->points().size()); });
}

Job field_distance() {
    oracle::Random random(seed);
    detail::FieldData<3> data;
    data.origin = Vec3(-8);
    data.cells = glm::uvec3(16);
    data.surface = {Vec3(-8), Vec3(8, 8, 0)};
    for (int z = -8; z <= 8; ++z)
        for (int i = 0; i < 17 * 17; ++i) data.distance.push_back(static_cast<float>(z));
    const Field3 field(std::move(data));
    std::vector<Vec3> points;
    while (points.size() < calls)
        points.emplace_back(random.uniform_float(-8, 8), random.uniform_float(-8, 8), random.uniform_float(-8, 8));
    return dirty_and_clear([field, points](std::size_t i) { return static_cast<double>(field.distance(points[i])); });
}

Job walk() {
    oracle::Random random(seed);
    const SharedWalkScene scene = walk_scene(32);
    std::vector<WalkPoint> places;
    std::vector<Vec3> steps;
    while (places.size() < calls) {
        const double x = random.uniform(1, 31), z = random.uniform(1, 31);
        places.push_back(scene->mesh.nearest(Vec3(static_cast<float>(x), 0, static_cast<float>(z))));
        steps.emplace_back(random.uniform_float(-0.2, 0.2), 0, random.uniform_float(-0.2, 0.2));
    }
    return dirty_and_clear([scene, places, steps](std::size_t i) {
        return static_cast<double>(scene->mesh.walk(places[i], steps[i]).length);
    });
}

Job laser() {
    const auto world = std::make_shared<World3>();
    world->add(Box3{{0, -1, 0}, {50, 1, 50}});
    world->update();
    std::vector<Ray3> rays;
    while (rays.size() < calls) rays.push_back({{static_cast<float>(rays.size()) * 0.01f, 5, 0}, {0, -1, 0}, 10});
    return dirty_and_clear(
        [world, rays](std::size_t i) { return static_cast<double>(Laser<3>(*world, rays[i]).hit()->hit.distance); });
}

}  // namespace

std::vector<Bench> upper_halves_benches() {
    return {
        {"broad/dirty/update-10", [] { return broad_phase(10, true); }},
        {"broad/dirty/set", [] { return broad_phase(1000, false); }},
        {"motion/dirty/ray-mesh", ray_and_mesh},
        {"motion/dirty/laser", laser},
        {"convex/dirty/polygon", polygon},
        {"field/dirty/distance", field_distance},
        {"walk/dirty/step", walk},
    };
}

}  // namespace abut::bench
