#pragma once

// Signed crossings of triangles by axis-parallel lines, for winding numbers. For .cpp files.

#include <abut/math/dvec.hpp>

#include <array>
#include <tuple>

namespace abut::detail {

/// Twice the signed area of a, b and the point, projected along an axis; positive on the left of ab. An edge gives the
/// same value in both directions (up to the sign), so that adjacent triangles agree about every point.
inline double left_of(const DVec<3>& a, const DVec<3>& b, const DVec<3>& point, int axis) {
    if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) return -left_of(b, a, point, axis);
    const int v = (axis + 1) % 3, w = (axis + 2) % 3;
    return (b[v] - a[v]) * (point[w] - a[w]) - (b[w] - a[w]) * (point[v] - a[v]);
}

/// The signed crossing of a triangle by the line through the point along an axis: 1, -1 or 0. Corners are half-open in
/// one coordinate, so that a line through a corner or an edge crosses exactly one of the triangles that share it.
inline int crossing_by_line(const std::array<DVec<3>, 3>& corners, const DVec<3>& point, int axis) {
    const int w = (axis + 2) % 3;
    int winding = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec<3>&from = corners[i], &to = corners[(i + 1) % 3];
        const bool from_below = from[w] <= point[w], to_below = to[w] <= point[w];
        if (from_below == to_below) continue;
        const double left = left_of(from, to, point, axis);
        if (from_below && left > 0) ++winding;
        if (to_below && left < 0) --winding;
    }
    return winding;
}

}  // namespace abut::detail
