#pragma once

// Polygons that are hard to decompose: stars, combs, plates with holes. Deterministic.

#include "../test/oracle/random.hpp"
#include "bumpy_ball.hpp"
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut::scenes {

using detail::DVec;
using detail::to_float;

struct Outline {
    std::vector<Vec2> ring;
    std::vector<std::vector<Vec2>> holes;
};

/// A star around a point: vertices at equal angles with random distances from `inner` x `radius` to `radius`.
/// Counter-clockwise.
inline std::vector<Vec2> star(std::uint32_t corners, double inner, std::uint64_t seed, DVec<2> middle = DVec<2>(0.0),
                              double radius = 1) {
    oracle::Random random(seed);
    std::vector<Vec2> result;
    for (std::uint32_t i = 0; i < corners; ++i)
        result.push_back(to_float(middle + on_circle(4.0 * i / corners) * (radius * random.uniform(inner, 1))));
    return result;
}

/// Alternating spikes at random distances from 0.7 to 1 of the origin and notches from 0.3 to 0.6. Counter-clockwise;
/// half of the vertices are reflex.
inline std::vector<Vec2> spiky_star(std::uint32_t corners, std::uint64_t seed) {
    oracle::Random random(seed);
    std::vector<Vec2> result;
    for (std::uint32_t i = 0; i < corners; ++i)
        result.push_back(
            to_float(on_circle(4.0 * i / corners) * (i % 2 == 0 ? random.uniform(0.7, 1) : random.uniform(0.3, 0.6))));
    return result;
}

/// A bar with teeth of 4 vertices each, whose roots are collinear. Counter-clockwise.
inline std::vector<Vec2> comb(std::uint32_t teeth) {
    std::vector<Vec2> result{{0, -1}, {static_cast<float>(2 * teeth - 1), -1}};
    for (std::uint32_t i = teeth; i-- > 0;) {
        const auto left = static_cast<float>(2 * i), right = static_cast<float>(2 * i + 1);
        if (i + 1 < teeth) result.emplace_back(right, 0.0f);
        result.emplace_back(right, 5.0f);
        result.emplace_back(left, 5.0f);
        if (i > 0) result.emplace_back(left, 0.0f);
    }
    return result;
}

/// A square with `rows` x `rows` stars of `corners` vertices as holes.
inline Outline plate(std::uint32_t rows, std::uint32_t corners, std::uint64_t seed) {
    const auto side = static_cast<float>(rows);
    Outline result{{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}};
    for (std::uint32_t i = 0; i < rows * rows; ++i)
        result.holes.push_back(star(corners, 0.4, seed + i, DVec<2>(i % rows + 0.5, i / rows + 0.5), 0.45));
    return result;
}

/// A simple polygon through all points: crossing edges are exchanged (2-opt) until none cross. Empty if that doesn't
/// terminate. Quadratic in the number of points per step.
inline std::vector<Vec2> simple_ring(std::vector<Vec2> points) {
    const std::size_t count = points.size();
    const auto corner = [&](std::size_t i) { return points[i % count]; };
    const auto on = [](const Vec2& a, const Vec2& b, const Vec2& p) {
        return orientation(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
               std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
    };
    const auto crosses = [&](std::size_t i, std::size_t j) {
        const Vec2 a = corner(i), b = corner(i + 1), c = corner(j), d = corner(j + 1);
        if (j == i + 1) return on(a, b, d) || on(c, d, a);
        if ((j + 1) % count == i) return on(a, b, c) || on(c, d, b);
        if (on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)) return true;
        return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
    };
    for (std::size_t steps = 0; steps < 20 * count; ++steps) {
        bool met = false;
        for (std::size_t i = 0; i < count && !met; ++i)
            for (std::size_t j = i + 1; j < count && !met; ++j)
                if (crosses(i, j)) {
                    met = true;
                    std::reverse(points.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                 points.begin() + static_cast<std::ptrdiff_t>(j) + 1);
                }
        if (!met) return points;
    }
    return {};
}

}  // namespace abut::scenes
