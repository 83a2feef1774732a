// Hulls with a vertex limit of coplanar points in 3D.

#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut::detail {

std::optional<Hull3> limited_flat_hull(const Hull3& full, std::span<const Vec3> points, std::size_t limit) {
    const DVec<3> normal = normalized(DVec<3>(full.normals[0])), origin(full.points[0]);
    const auto height = [&](const Vec3& point) { return dot(normal, DVec<3>(point) - origin); };
    // The plane midway between the lowest and the highest point, seen along the axis nearest to its normal.
    const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                                 [&](const Vec3& a, const Vec3& b) { return height(a) < height(b); });
    const double middle = 0.5 * (height(*low) + height(*high));
    const int up = longest_axis(normal), right = (up + 1) % 3, ahead = (up + 2) % 3;
    const bool level =
        std::all_of(points.begin(), points.end(), [&](const Vec3& point) { return point[up] == points[0][up]; });

    // The slopes of the plane, and a map of the projection that restores lengths: a root of (1 + x x, x y; x y, 1 + y
    // y).
    const double x = -normal[right] / normal[up], y = -normal[ahead] / normal[up], root = std::sqrt(1 + x * x);
    Affine<2> to_plane;
    to_plane.column = {DVec<2>(root, 0), DVec<2>(x * y / root, std::sqrt(1 + x * x + y * y) / root)};
    std::vector<Vec2> seen, inner;
    for (const Vec3& point : points) seen.emplace_back(point[right], point[ahead]);
    for (const std::uint32_t i : hull_loop(seen)) inner.push_back(seen[i]);
    const std::optional<Hull2> outer = outline_of(inner, limit, to_plane);
    if (!outer) return std::nullopt;

    std::vector<Vec3> corners;
    for (const Vec2& corner : outer->points) {
        Vec3& lifted = corners.emplace_back();
        lifted[right] = corner.x;
        lifted[ahead] = corner.y;
        const double rise =
            x * (static_cast<double>(corner.x) - origin[right]) + y * (static_cast<double>(corner.y) - origin[ahead]);
        lifted[up] = static_cast<float>(level ? origin[up] : origin[up] + middle / normal[up] + rise);
        const double tolerance = hull_tolerance * extent<3>(full.points);
        if (!is_finite(lifted) || !(std::abs(height(lifted) - middle) <= tolerance)) return std::nullopt;
    }
    std::sort(corners.begin(), corners.end(), [](const Vec3& a, const Vec3& b) { return less(a, b); });
    return flat_hull(corners, normal, points);
}

}  // namespace abut::detail
