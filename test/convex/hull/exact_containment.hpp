#pragma once

// Whether points lie in the convex hull of others, in rational numbers where doubles are undecided.

#include "../../oracle/rational.hpp"
#include <abut/math/dvec.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace abut::test {

using detail::axis;
using detail::DVec;
using oracle::Rational;

/// The side of the plane abc, or of the line ab, that p is on: 1 to the left of ab, and 1 where abc is
/// counter-clockwise.
inline int side_of(const std::array<Vec2, 2>& line, const Vec2& p) {
    const DVec<2> u = DVec<2>(line[1]) - DVec<2>(line[0]), v = DVec<2>(p) - DVec<2>(line[0]);
    const double one = u.x * v.y, other = u.y * v.x;
    if (std::abs(one - other) > 4e-15 * (std::abs(one) + std::abs(other))) return one > other ? 1 : -1;
    const auto difference = [&](const Vec2& a, int i) {
        return Rational(static_cast<double>(a[i])) - Rational(static_cast<double>(line[0][i]));
    };
    const Rational exact = difference(line[1], 0) * difference(p, 1) - difference(line[1], 1) * difference(p, 0);
    return exact.sign();
}
inline int side_of(const std::array<Vec3, 3>& plane, const Vec3& p) {
    const DVec<3> o(plane[0]), u = DVec<3>(plane[1]) - o, v = DVec<3>(plane[2]) - o, w = DVec<3>(p) - o;
    double sum = 0, size = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += (u[j] * v[k] - u[k] * v[j]) * w[i];
        size += (std::abs(u[j] * v[k]) + std::abs(u[k] * v[j])) * std::abs(w[i]);
    }
    if (std::abs(sum) > 4e-15 * size) return sum > 0 ? 1 : -1;
    std::array<std::array<Rational, 3>, 3> seen;
    const std::array<Vec3, 3> points{plane[1], plane[2], p};
    for (std::size_t i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis)
            seen[i][static_cast<std::size_t>(axis)] =
                Rational(static_cast<double>(points[i][axis])) - Rational(static_cast<double>(plane[0][axis]));
    const auto& [a, b, c] = seen;
    const Rational exact =
        (a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] + (a[0] * b[1] - a[1] * b[0]) * c[2];
    return exact.sign();
}

/// The number of points on the wrong side of a line or plane that has all corners on its other side.
template <std::size_t N, class Point>
std::size_t count_beyond(const std::array<Point, N>& plane, std::span<const Point> corners,
                         std::span<const Point> points) {
    bool above = false, below = false;
    for (const Point& corner : corners) {
        const int side = side_of(plane, corner);
        above = above || side > 0;
        below = below || side < 0;
        if (above && below) return 0;
    }
    if (above == below) return 0;  // degenerate: not a plane
    return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Point& point) {
        const int side = side_of(plane, point);
        return above ? side < 0 : side > 0;
    }));
}

/// The number of times a point is outside of a supporting plane through corners: 0 if all points are in the convex hull
/// of the corners. The corners mustn't be collinear (of a flat set: coplanar points only).
inline std::size_t count_outside(std::span<const Vec2> corners, std::span<const Vec2> points) {
    std::size_t result = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) result += count_beyond<2, Vec2>({corners[i], corners[j]}, corners, points);
    return result;
}
inline std::size_t count_outside(std::span<const Vec3> corners, std::span<const Vec3> points) {
    std::size_t result = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (std::size_t k = 0; k < j; ++k)
                result += count_beyond<3, Vec3>({corners[i], corners[j], corners[k]}, corners, points);
    return result;
}

}  // namespace abut::test
