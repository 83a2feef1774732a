#pragma once

// A closed bumpy surface, similar to a scanned stone.

#include "../test/oracle/random.hpp"
#include <abut/math/dvec.hpp>
#include <abut/math/vec.hpp>

#include <cstdint>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::scenes {

using abut::detail::DVec;
using abut::detail::to_float;

struct BumpyBall {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
};

/// The point of the unit circle after a number of quarter turns, without trigonometric functions: deterministic.
inline DVec<2> on_circle(double quarters) {
    const int whole = static_cast<int>(quarters);
    const double t = quarters - whole, scale = 1 / (1 + t * t);
    const DVec<2> first((1 - t * t) * scale, 2 * t * scale);
    switch (whole % 4) {
        case 0:
            return first;
        case 1:
            return {-first.y, first.x};
        case 2:
            return -first;
        default:
            return {first.y, -first.x};
    }
}

/// A mesh of radius 1 about the origin, oriented outwards: `rows` rings of 2 `rows` quads of two triangles; those at
/// the poles have one.
/// Waves have amplitude `waves`, and vertices are displaced by up to `roughness`.
inline BumpyBall bumpy_ball(std::uint32_t rows, double waves, double roughness, oracle::Random& random) {
    BumpyBall result;
    const std::uint32_t columns = 2 * rows;
    const auto add = [&](std::uint32_t row, std::uint32_t column) {
        const DVec<2> down = on_circle(2.0 * row / rows), around = on_circle(4.0 * column / columns);
        const DVec<3> direction(down.y * around.x, down.y * around.y, down.x);
        const DVec<2> ripple = on_circle(64.0 + 9 * direction.x + 7 * direction.y + 11 * direction.z);
        const double bump = direction.x * direction.y * direction.z * 3 + 0.2 * ripple.y;
        result.points.push_back(to_float(direction * (1 + waves * bump + random.uniform(-roughness, roughness))));
    };
    add(0, 0);
    for (std::uint32_t row = 1; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) add(row, column);
    add(rows, 0);
    const auto index = [&](std::uint32_t row, std::uint32_t column) {
        return 1 + (row - 1) * columns + column % columns;
    };
    const auto last = static_cast<std::uint32_t>(result.points.size() - 1);
    for (std::uint32_t column = 0; column < columns; ++column) {
        result.triangles.emplace_back(0u, index(1, column), index(1, column + 1));
        for (std::uint32_t row = 1; row + 1 < rows; ++row) {
            result.triangles.emplace_back(index(row, column), index(row + 1, column), index(row + 1, column + 1));
            result.triangles.emplace_back(index(row, column), index(row + 1, column + 1), index(row, column + 1));
        }
        result.triangles.emplace_back(last, index(rows - 1, column + 1), index(rows - 1, column));
    }
    return result;
}

}  // namespace abut::scenes
