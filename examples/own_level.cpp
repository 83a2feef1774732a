// A user-defined level of voxels. Two functions found by argument-dependent lookup make it a shape for all queries and
// for a World:
// `bounds`, and `each_part`, which visits the parts in a box. A grid needs no tree to find its cells.

#include <abut/abut.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace game {

struct Voxels {
    int width, depth, height;
    std::vector<bool> solid = std::vector<bool>(static_cast<std::size_t>(width * depth * height));

    int index(int x, int y, int z) const { return (z * depth + y) * width + x; }
    void fill(int x, int y, int z) { solid[static_cast<std::size_t>(index(x, y, z))] = true; }
};

abut::Aabb3 bounds(const Voxels& v) {
    return {{0, 0, 0}, {v.width, v.depth, v.height}};
}

/// Calls visit(part, number) for the cells in the box, and possibly more; the visitor returns false to stop. A part is
/// any convex shape.
template <class Visit>
void each_part(const Voxels& v, const abut::Aabb3& box, Visit&& visit) {
    const auto cell = [](float at, int count) {
        return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(count - 1)));
    };
    for (int z = cell(box.min.z - 1, v.height); z <= cell(box.max.z, v.height); ++z)
        for (int y = cell(box.min.y - 1, v.depth); y <= cell(box.max.y, v.depth); ++y)
            for (int x = cell(box.min.x - 1, v.width); x <= cell(box.max.x, v.width); ++x) {
                const int number = v.index(x, y, z);
                if (!v.solid[static_cast<std::size_t>(number)]) continue;
                const abut::Aabb3 part{{x, y, z}, {x + 1, y + 1, z + 1}};
                if (!visit(part, static_cast<std::uint32_t>(number))) return;
            }
}

}  // namespace game

int main() {
    game::Voxels level{16, 16, 8};
    for (int x = 0; x < 16; ++x)
        for (int y = 0; y < 16; ++y) level.fill(x, y, 0);
    level.fill(8, 8, 1);

    const abut::Sphere ball{{8.5f, 8.5f, 6}, 0.5f};
    const auto landed = abut::sweep(ball, abut::Vec3(0, 0, -10), level);
    if (!landed) return 1;
    std::printf("a ball lands after %g, on voxel %u\n", static_cast<double>(landed->distance), landed->feature.part);

    abut::World3 world;
    world.add(level, {.pose = {{100, 0, 0}}, .fixed = true});
    const auto hit = world.raycast(abut::Ray3::between({98, 8.5f, 1.5f}, {120, 8.5f, 1.5f}));
    if (!hit) return 1;
    std::printf("a ray in the world hits voxel %u after %g\n", hit->hit.feature.part,
                static_cast<double>(hit->hit.distance));
    const bool as_expected =
        landed->distance == 3.5f && hit->hit.distance == 10 && landed->feature.part == hit->hit.feature.part &&
        abut::contains(level, abut::Vec3(3, 3, 0.5f)) && !abut::contains(level, abut::Vec3(3, 3, 1.5f));
    return as_expected ? 0 : 1;
}
