// A crate slides over a floor of many triangles and hits a wall; a bullet doesn't tunnel through a thin wall.
#include <abut/abut.hpp>

#include <cstdio>
#include <vector>

int main() {
    // A floor of triangles, and a wall on it.
    std::vector<abut::Vec3> points;
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 0; i <= 16; ++i) {
        points.push_back({static_cast<float>(i), 0, -4});
        points.push_back({static_cast<float>(i), 0, 4});
        if (i == 16) break;
        triangles.push_back({2 * i, 2 * i + 1, 2 * i + 2});
        triangles.push_back({2 * i + 2, 2 * i + 1, 2 * i + 3});
    }
    const abut::Mesh floor = *abut::Mesh::build(points, triangles);
    const abut::Box3 wall{{12, 1, 0}, {0.0005f, 1, 4}};

    // The crate rests on the floor: sliding over internal edges is no hit.
    const abut::Box3 crate{{2, 0.5f, 0.3f}, {0.5f, 0.5f, 0.5f}};
    const abut::Vec3 push{14, 0, 0};
    if (sweep(crate, push, floor)) return 1;
    const auto hit = sweep(crate, push, wall);
    if (!hit) return 1;
    std::printf("the crate slides %.4f and hits the wall at %.4f %.4f %.4f\n", static_cast<double>(hit->distance),
                static_cast<double>(hit->point.x), static_cast<double>(hit->point.y),
                static_cast<double>(hit->point.z));

    // The bullet moves some thousand times its own size in one step.
    const abut::Sphere bullet{{-40, 1.2f, 0}, 0.005f};
    const auto shot = sweep(bullet, {100, 0, 0}, wall);
    if (!shot || !(shot->normal.x < -0.999f)) return 1;
    std::printf("the bullet hits it at %.4f of its step\n", static_cast<double>(shot->fraction));

    // Both move: the fraction is the same time for both.
    const abut::Capsule3 gate{{20, 0, 0}, {20, 2, 0}, 0.1f};
    const auto both = sweep(bullet, {100, 0, 0}, gate, {-10, 0, 0});
    if (!both || !(both->point.x > 10 && both->point.x < 20)) return 1;
    std::printf("and the gate, which comes towards it, at x = %.4f\n", static_cast<double>(both->point.x));
    return 0;
}
