// A 3D character controller in 20 lines: walks over hills and stairs and along a wall, and never through anything.
#include <abut/abut.hpp>

#include <cstdio>
#include <vector>

int main() {
    // Hills of triangles, stairs, and a wall across the path.
    std::vector<abut::Vec3> points;
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t z = 0; z <= 20; ++z)
        for (std::uint32_t x = 0; x <= 20; ++x)
            points.push_back({x, 0.1f * static_cast<float>((x * 7 + z * 5) % 6), z});
    for (std::uint32_t z = 0; z < 20; ++z)
        for (std::uint32_t x = 0; x < 20; ++x) {
            const std::uint32_t i = z * 21 + x;
            triangles.push_back({i, i + 21, i + 1});
            triangles.push_back({i + 1, i + 21, i + 22});
        }
    abut::World3 world;
    world.add(*abut::Mesh::build(points, triangles), {.fixed = true});
    for (int i = 1; i <= 10; ++i) {
        const float step = static_cast<float>(i);
        world.add(abut::Box3{{20 + 0.5f * step, 0.125f * step, 10}, {0.25f, 0.125f * step, 10}}, {.fixed = true});
    }
    const abut::Id wall = world.add(abut::Box3{{30, 5, 10}, {0.5f, 5, 10}}, {.fixed = true});
    world.add(abut::Box3{{27.5f, 1.2f, 10}, {2.25f, 0.05f, 10}}, {.fixed = true});  // the landing

    abut::Mover3 mover;
    const abut::Capsule3 hero{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.4f};
    abut::Vec3 position{2, 2, 4}, velocity{4, 0, 1};
    bool met_wall = false;
    for (int frame = 0; frame < 600; ++frame) {
        const float dt = 1.0f / 60;
        velocity.y -= 20 * dt;
        const auto moved = mover.move(world, hero, position, velocity * dt);
        position = moved.position;
        if (moved.grounded) velocity.y = 0;
        for (const auto& touch : moved.touches) met_wall = met_wall || touch.id == wall;
        if (!world.overlapping(at(hero, abut::Pose3{position})).empty()) return 1;
    }
    std::printf("ends at %.2f %.2f %.2f\n", static_cast<double>(position.x), static_cast<double>(position.y),
                static_cast<double>(position.z));
    return met_wall && position.y > 2 ? 0 : 1;
}
