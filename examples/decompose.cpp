// Decomposes a mesh to convex parts and combines them to one shape. A ball rolls over the seams without ghost
// collisions.

#include <abut/abut.hpp>
#include <abut/bake.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <variant>
#include <vector>

namespace {

/// An L-shaped platform with its top at y = 1. The outline is counter-clockwise seen from above, and star-shaped around
/// corner 3.
struct Platform {
    std::vector<abut::Vec3> points;
    std::vector<glm::uvec3> triangles;
};

Platform platform() {
    const std::vector<abut::Vec2> outline{{0, 0}, {6, 0}, {6, -2}, {2, -2}, {2, -6}, {0, -6}};
    const auto count = static_cast<std::uint32_t>(outline.size());
    Platform result;
    for (const abut::Vec2& corner : outline)
        for (const float y : {0.0f, 1.0f}) result.points.emplace_back(corner.x, y, corner.y);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % count);
        result.triangles.insert(result.triangles.end(), {{a, b, a + 1}, {b, b + 1, a + 1}});
    }
    constexpr std::uint32_t from = 3;
    for (std::uint32_t i = 1; i + 1 < count; ++i) {
        const std::uint32_t a = 2 * from, b = 2 * ((from + i) % count), c = 2 * ((from + i + 1) % count);
        result.triangles.insert(result.triangles.end(), {{a, c, b}, {a + 1, b + 1, c + 1}});
    }
    return result;
}

}  // namespace

int main() {
    const Platform mesh = platform();
    const auto good = abut::repair(mesh.points, mesh.triangles);  // meshes from files usually need repair
    if (!good) return 1;
    std::printf("mesh: %s\n", abut::described(good->repairs).c_str());

    const auto parts = abut::decompose(good->points, good->triangles);
    if (!parts) return 1;
    for (const abut::Polyhedron& part : *parts) {
        const auto nearly = abut::fit(part);
        std::printf("a part of %zu corners, volume %g%s\n", part.points().size(), part.volume(),
                    nearly && std::holds_alternative<abut::Box3>(nearly->shape) ? ", a box" : "");
    }
    const std::vector<abut::AnyShape<3>> children(parts->begin(), parts->end());
    const abut::Compound3 ground = *abut::Compound3::build(children);

    // A ball rolls along one arm, around the corner and along the other arm, over the seam.
    abut::Sphere ball{{5.5f, 1.5f, -1}, 0.5f};
    float lean = 0;
    int steps = 0;
    const auto roll = [&](const abut::Vec3& motion) {
        if (abut::sweep(ball, motion, ground)) return false;
        constexpr int count = 64;
        for (int i = 0; i < count; ++i, ++steps) {
            ball.center += motion / static_cast<float>(count);
            // Slightly lower, so that it touches everywhere.
            const abut::Sphere lower{ball.center - abut::Vec3(0, 1e-3f, 0), ball.radius};
            abut::each_contact(lower, ground, [&](const abut::Contact<3>& contact) {
                lean = std::max({lean, std::abs(contact.normal.x), std::abs(contact.normal.z)});
            });
        }
        return true;
    };
    const bool went_round = roll({-4.5f, 0, 0}) && roll({0, 0, -4});
    std::printf("%d steps round the corner, normals lean by %g at most\n", steps, static_cast<double>(lean));

    const auto wall = abut::sweep(abut::Sphere{{6, 0.5f, -5}, 0.5f}, abut::Vec3(-5, 0, 0), ground);
    if (!wall) return 1;
    std::printf("from outside it hits the other arm after %g\n", static_cast<double>(wall->distance));
    const bool as_expected =
        parts->size() == 2 && went_round && lean < 1e-6f && std::abs(wall->distance - 3.5f) < 1e-4f;
    return as_expected ? 0 : 1;
}
