#pragma once

// Meshes for paths.

#include "../oracle/random.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using detail::length;

struct Ground {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint8_t> areas;

    WalkMesh mesh() const {
        Result<WalkMesh> built = WalkMesh::build(points, triangles, {}, areas);
        EXPECT_TRUE(built);
        return *built;
    }
};

/// A floor of `columns` x `rows` unit squares of two triangles each, in the plane z = 0. `there(column, row)` selects
/// the squares, `height(x, y)` raises their corners.
template <class There, class Height>
Ground grid(int columns, int rows, There&& there, Height&& height) {
    Ground result;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x)
            result.points.emplace_back(static_cast<float>(x), static_cast<float>(y), static_cast<float>(height(x, y)));
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            if (!there(x, y)) continue;
            const auto a = static_cast<std::uint32_t>(y * (columns + 1) + x), b = a + 1;
            const std::uint32_t c = a + static_cast<std::uint32_t>(columns) + 1, d = c + 1;
            // The diagonals alternate like a chess board.
            if ((x + y) % 2 == 0) {
                result.triangles.emplace_back(a, b, d);
                result.triangles.emplace_back(a, d, c);
            } else {
                result.triangles.emplace_back(a, b, c);
                result.triangles.emplace_back(b, d, c);
            }
        }
    return result;
}
template <class There>
Ground grid(int columns, int rows, There&& there) {
    return grid(columns, rows, there, [](int, int) { return 0; });
}
inline bool everywhere(int, int) {
    return true;
}

inline WalkPoint random_place(const WalkMesh& mesh, oracle::Random& random) {
    const auto count = static_cast<std::uint32_t>(mesh.triangles().size());
    for (;;) {
        const std::uint32_t triangle = random.below(count);
        if (!mesh.is_walkable(triangle)) continue;
        const float second = random.uniform_float(0, 0.5);
        const float third = random.uniform_float(0, 0.5);
        return {triangle, {1 - second - third, second, third}};
    }
}

inline double distance(const Vec3& a, const Vec3& b) {
    return length(detail::DVec<3>(a) - detail::DVec<3>(b));
}
inline double length_of(const std::vector<Vec3>& points) {
    double result = 0;
    for (std::size_t i = 1; i < points.size(); ++i) result += distance(points[i - 1], points[i]);
    return result;
}

/// Checks the invariants of a path: its ends, its length, its places at its points, and that a walk along each piece
/// ends where the next begins.
inline void expect_whole(const WalkMesh& mesh, const WalkPoint& from, const WalkPoint& to, const WalkPath& path,
                         double tolerance, const std::optional<WalkAllow>& allow = std::nullopt) {
    ASSERT_GE(path.points.size(), 2u);
    ASSERT_EQ(path.points.size(), path.places.size());
    EXPECT_LE(distance(path.points.front(), mesh.to_world(from)), tolerance);
    if (path.reached) {
        EXPECT_LE(distance(path.points.back(), mesh.to_world(to)), tolerance);
        EXPECT_EQ(path.places.back().triangle, to.triangle);
    }
    EXPECT_NEAR(length_of(path.points), path.length, tolerance * static_cast<double>(path.points.size()));
    for (std::size_t i = 0; i < path.points.size(); ++i) {
        const Vec3& w = path.places[i].weights;
        EXPECT_TRUE(w.x >= 0 && w.y >= 0 && w.z >= 0);
        EXPECT_EQ(w.x + w.y + w.z, 1.0f);
        EXPECT_LE(distance(path.points[i], mesh.to_world(path.places[i])), tolerance) << "point " << i;
    }
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
        const Walked walked = mesh.walk(path.places[i], path.points[i + 1] - path.points[i], {.allow = allow});
        EXPECT_LE(distance(mesh.to_world(walked.place), path.points[i + 1]), 4 * tolerance) << "piece " << i;
    }
}

}  // namespace abut::test
