#pragma once

// Surfaces of every kind to walk on.

#include "../../scenes/bumpy_ball.hpp"
#include "../../scenes/solid_meshes.hpp"
#include "../../scenes/terrain.hpp"
#include "../shape/meshes.hpp"
#include <abut/math/dvec.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using detail::DVec;
using detail::length;
using detail::to_float;

/// The point of a sheet in this column and row.
using Sheet = std::function<DVec<3>(std::uint32_t column, std::uint32_t row)>;

/// Squares of two triangles each. `is_there` leaves holes.
inline Surface sheet(std::uint32_t columns, std::uint32_t rows, const Sheet& at,
                     const std::function<bool(std::uint32_t, std::uint32_t)>& is_there = nullptr) {
    Surface result;
    for (std::uint32_t row = 0; row <= rows; ++row)
        for (std::uint32_t column = 0; column <= columns; ++column) result.points.push_back(to_float(at(column, row)));
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            if (is_there && !is_there(column, row)) continue;
            const std::uint32_t a = row * (columns + 1) + column, b = a + 1, c = b + columns + 1, d = c - 1;
            result.triangles.emplace_back(a, b, c);
            result.triangles.emplace_back(a, c, d);
        }
    return result;
}

inline Surface flat(std::uint32_t columns, std::uint32_t rows) {
    return sheet(columns, rows, [](std::uint32_t column, std::uint32_t row) { return DVec<3>(column, row, 0); });
}

/// Heights are integers over a power of 2, so that no compiler's rounding affects them.
inline Surface stepped_hills(std::uint32_t columns, oracle::Random& random) {
    Surface result = flat(columns, columns);
    for (Vec3& point : result.points) point.z = static_cast<float>(random.below(64)) / 16;
    return result;
}

/// A flat floor with square holes in it, some of which touch at a corner.
inline Surface flat_with_holes(std::uint32_t columns, oracle::Random random) {
    return sheet(
        columns, columns, [](std::uint32_t column, std::uint32_t row) { return DVec<3>(column, row, 0); },
        [&](std::uint32_t, std::uint32_t) { return random.chance(0.8); });
}

/// Hills without angles: z is a polynomial of x and y.
inline Surface hills(std::uint32_t columns) {
    return sheet(columns, columns, [&](std::uint32_t column, std::uint32_t row) {
        const double x = 2.0 * column / columns - 1, y = 2.0 * row / columns - 1;
        return DVec<3>(column, row, 0.2 * columns * (x * x * x - x + y * y - 2 * x * y * y));
    });
}

/// Like a folded fan: every strip turns back by nearly pi.
inline Surface accordion(std::uint32_t folds, std::uint32_t rows) {
    return sheet(folds, rows, [](std::uint32_t column, std::uint32_t row) {
        return DVec<3>(0.1 * column, row, column % 2 == 0 ? 0 : 1);
    });
}

/// Long thin triangles, perpendicular to each other.
inline Surface slats(std::uint32_t columns) {
    return sheet(columns, columns, [](std::uint32_t column, std::uint32_t row) {
        return DVec<3>(column, 0.001 * row, 0.0003 * ((column * 7 + row * 3) % 5));
    });
}

/// A tube, open at both ends.
inline Surface tube(std::uint32_t sides, std::uint32_t rings) {
    return sheet(sides, rings, [&](std::uint32_t column, std::uint32_t row) {
        const DVec<2> around = scenes::on_circle(4.0 * (column % sides) / sides);
        return DVec<3>(around.x, around.y, 0.2 * row);
    });
}

/// A strip with `half_turns` half turns of twist.
inline Surface twisted_strip(std::uint32_t columns, std::uint32_t rows, std::uint32_t half_turns) {
    const std::uint32_t whole = half_turns % 2;
    return sheet(columns, rows, [&](std::uint32_t column, std::uint32_t row) {
        const bool closes = column == columns;
        const std::uint32_t ring = closes ? 0 : column, line = closes && whole == 1 ? rows - row : row;
        const DVec<2> around = scenes::on_circle(4.0 * ring / columns);
        const DVec<2> twist = scenes::on_circle(2.0 * half_turns * ring / columns);
        const double across = 0.8 * (2.0 * line / rows - 1);
        const double out = 2 + across * twist.x;
        return DVec<3>(around.x * out, around.y * out, across * twist.y);
    });
}

/// A track through a loop, upside down at the top; its ends pass beside each other.
inline Surface loop(std::uint32_t columns, std::uint32_t rows) {
    return sheet(columns, rows, [&](std::uint32_t column, std::uint32_t row) {
        const double at = 5.0 * column / columns;
        const DVec<2> around = scenes::on_circle(at);
        return DVec<3>(2 * around.x, at + 0.8 * row / rows, 2 * around.y);
    });
}

/// A fan around the origin with these rim heights: the angle around a tip is below 2 pi, around a saddle above.
inline Surface fan(const std::vector<double>& heights) {
    Surface result;
    result.points.emplace_back(0.0f, 0.0f, 0.0f);
    const auto count = static_cast<std::uint32_t>(heights.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const DVec<2> around = scenes::on_circle(4.0 * i / count);
        result.points.push_back(to_float(DVec<3>(around.x, around.y, heights[i])));
        result.triangles.emplace_back(0u, 1 + i, 1 + (i + 1) % count);
    }
    return result;
}

/// Cubes that also share only edges and corners.
inline Surface random_cubes(oracle::Random random) {
    std::vector<bool> full;
    for (int i = 0; i < 125; ++i) full.push_back(random.chance(0.5));
    return cell_surface(5, [&](int x, int y, int z) { return full[static_cast<std::size_t>(25 * x + 5 * y + z)]; });
}

/// The mesh of a surface that must build.
inline WalkMesh built(const Surface& surface, std::span<const Vec3> normals = {},
                      std::span<const std::uint8_t> areas = {}) {
    Result<WalkMesh> result = WalkMesh::build(surface.points, surface.triangles, normals, areas);
    EXPECT_TRUE(result) << (result ? "" : result.problem().message);
    return *std::move(result);
}

struct NamedSurface {
    std::string name;
    Surface surface;
};

inline std::vector<NamedSurface> surfaces(std::uint64_t seed) {
    oracle::Random random(seed);
    const auto of = [](auto made) { return Surface{std::move(made.points), std::move(made.triangles)}; };
    std::vector<NamedSurface> result;
    result.push_back({"flat", flat(12, 12)});
    result.push_back({"flat with holes", flat_with_holes(16, random)});
    result.push_back({"hills", hills(24)});
    result.push_back({"terrain", of(scenes::random_terrain(16, random))});
    result.push_back({"ceiling", reversed(of(scenes::random_terrain(10, random)))});
    result.push_back({"ball", of(scenes::bumpy_ball(12, 0, 0, random))});
    result.push_back({"bumpy ball", of(scenes::bumpy_ball(16, 0.2, 0.05, random))});
    result.push_back({"house", of(scenes::house())});
    result.push_back({"cubes", random_cubes(random)});
    result.push_back({"box", box_surface({0, 0, 0}, {1, 2, 3})});
    result.push_back({"knotted tube", of(scenes::knotted_tube(60, 8))});
    result.push_back({"tube", tube(9, 12)});
    result.push_back({"accordion", accordion(20, 6)});
    result.push_back({"slats", slats(12)});
    result.push_back({"Moebius strip", twisted_strip(24, 3, 1)});
    result.push_back({"twisted strip", twisted_strip(24, 3, 2)});
    result.push_back({"loop", loop(40, 4)});
    result.push_back({"cone", fan(std::vector<double>(7, -1.5))});
    result.push_back({"saddle", fan({1, -1, 1, -1, 1, -1, 1, -1})});
    return result;
}

/// The diagonal of the points' bounding box.
inline double size_of(const Surface& surface) {
    Aabb3 box = Aabb3::empty();
    for (const Vec3& point : surface.points) box = merged(box, Aabb3{point, point});
    return length(DVec<3>(box.max) - DVec<3>(box.min));
}

/// The mean length of the edges.
inline double edge_of(const Surface& surface) {
    double sum = 0;
    for (const glm::uvec3& t : surface.triangles)
        for (int k = 0; k < 3; ++k)
            sum += length(DVec<3>(surface.points[t[k]]) - DVec<3>(surface.points[t[(k + 1) % 3]]));
    return sum / (3 * static_cast<double>(surface.triangles.size()));
}

}  // namespace abut::test
