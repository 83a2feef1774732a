// The triangles that a mesh reports along the path of a moving box, against separating axes of box and triangle over
// the time of the motion in double, on all SIMD targets.

#include "../../scenes/terrain.hpp"
#include "../oracle/random.hpp"
#include "../oracle/simd_targets.hpp"
#include <abut/math/dvec.hpp>
#include <abut/math/ray.hpp>
#include <abut/shape/mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace abut::test {

using namespace detail;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The time at which a moving box enters a triangle, or infinity.
double entry_of(const MovingBox<3>& box, const Triangle3& triangle) {
    const std::array<DVec<3>, 3> corners{DVec<3>(triangle.a), DVec<3>(triangle.b), DVec<3>(triangle.c)};
    double from = 0, to = box.length;
    const auto clip = [&](const DVec<3>& axis) {
        double low = infinity, high = -infinity;
        for (const DVec<3>& corner : corners) {
            low = std::min(low, dot(axis, corner - box.center));
            high = std::max(high, dot(axis, corner - box.center));
        }
        const double reach =
            std::abs(axis.x) * box.half.x + std::abs(axis.y) * box.half.y + std::abs(axis.z) * box.half.z;
        const double speed = dot(axis, box.direction), first = low - reach, last = high + reach;
        if (std::abs(speed) < 1e-12) {
            if (first > 0 || last < 0) to = -infinity;
            return;
        }
        from = std::max(from, std::min(first / speed, last / speed));
        to = std::min(to, std::max(first / speed, last / speed));
    };
    clip(cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (int i = 0; i < 3; ++i) {
        clip(axis<3>(i));
        for (std::size_t j = 0; j < 3; ++j) clip(cross(axis<3>(i), corners[(j + 1) % 3] - corners[j]));
    }
    return from <= to ? from : infinity;
}

MovingBox<3> random_box(double half_width, oracle::Random& random) {
    MovingBox<3> box;
    box.center = random.in_cube<3>() * half_width;
    box.center.y *= 0.1;
    for (int i = 0; i < 3; ++i) box.half[i] = random.uniform(0, 1) < 0.2 ? 0 : random.uniform(0, 0.5);
    DVec<3> direction = random.in_cube<3>();
    direction.y *= random.uniform(0, 1) < 0.5 ? 0.05 : 1;
    if (random.uniform(0, 1) < 0.1) direction = axis<3>(random.uniform(0, 1) < 0.5 ? 0 : 1, -1);
    box.direction = normalized(direction) * random.uniform(0.5, 2);
    box.length = random.uniform(0, 2) * half_width;
    return box;
}

using MeshAlong = oracle::BySimdTarget;

TEST_P(MeshAlong, VisitsWhatAMovingBoxTouchesAndLittleElse) {
    oracle::Random random(7);
    constexpr std::uint32_t columns = 24;
    const scenes::Terrain ground = scenes::random_terrain(columns, random);
    for (const float scale : {1e-3f, 1.0f, 1e3f}) {
        std::vector<Vec3> points = ground.points;
        const Vec3 far = scale * Vec3(300, -40, 7);
        for (Vec3& point : points) point = point * scale + far;
        const Mesh mesh = *Mesh::build(points, ground.triangles);
        int touched = 0, visited = 0, first_hits = 0;
        for (int i = 0; i < 150; ++i) {
            MovingBox<3> box = random_box(0.5 * columns, random);
            box.center = box.center * static_cast<double>(scale) + DVec<3>(far);
            box.half *= static_cast<double>(scale);
            box.length *= static_cast<double>(scale);
            std::set<std::uint32_t> seen;
            each_part_along(mesh, box, [&](const Triangle3&, std::uint32_t index) {
                seen.insert(index);
                return std::numeric_limits<float>::infinity();
            });
            visited += static_cast<int>(seen.size());
            double first = infinity;
            for (std::uint32_t t = 0; t < ground.triangles.size(); ++t) {
                const double entry = entry_of(box, mesh.triangle(t));
                first = std::min(first, entry);
                if (!(entry < infinity)) continue;
                ++touched;
                EXPECT_TRUE(seen.contains(t)) << "box " << i << ", triangle " << t << " at " << entry;
            }
            double found = infinity;
            each_part_along(mesh, box, [&](const Triangle3& triangle, std::uint32_t) {
                found = std::min(found, entry_of(box, triangle));
                return static_cast<float>(found);
            });
            EXPECT_EQ(found, first) << "box " << i;
            first_hits += first < infinity ? 1 : 0;
        }
        EXPECT_GT(first_hits, 45);
        EXPECT_LT(first_hits, 140);
        // The boxes of 1.5 to 1.6 times as many triangles are touched.
        EXPECT_GT(touched, 600);
        EXPECT_LT(visited, touched * 1.15) << touched;
    }
}

INSTANTIATE_TEST_SUITE_P(SimdTargets, MeshAlong, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace

}  // namespace abut::test
