// Hulls with a vertex limit in 2D, and of coplanar points in 3D.

#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/convex/hull/limited/outer_polygon.hpp>
#include <abut/convex/hull/limited/round_outwards.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace abut::detail {

double size_of(const Hull2& hull) {
    return area_of(Loop2(hull.points.begin(), hull.points.end()));
}

std::optional<Hull2> hull_around(std::span<const Vec2> corners, std::span<const Vec2> points,
                                 const StretchedFrame<2>&) {
    Hull2 result{{}, 2};
    for (const std::uint32_t i : hull_loop(corners)) result.points.push_back(corners[i]);
    const std::size_t count = result.points.size();
    if (count < 3) return std::nullopt;
    for (std::size_t i = 0; i < count; ++i)
        for (const Vec2& point : points)
            if (orientation(result.points[i], result.points[(i + 1) % count], point) < 0) return std::nullopt;
    return result;
}

std::optional<Hull2> outline_of(std::span<const Vec2> hull_points, std::size_t limit, const Affine<2>& seen) {
    const std::optional<StretchedFrame<2>> frame = stretched_frame<2>(hull_points, hull_points);
    if (!frame) return std::nullopt;
    Loop2 inner;
    for (const Vec2& point : hull_points) inner.push_back(frame->from_world(DVec<2>(point)));
    std::vector<OuterBody<2>> bodies;
    for (const Loop2& loop : outer_polygons(inner, limit, seen * frame->out)) {
        OuterBody<2> body{area_of(loop) * determinant(frame->out), loop, {}, {}};
        const auto count = static_cast<std::uint32_t>(loop.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            const DVec<2> along = loop[(i + 1) % count] - loop[i], normal = normalized(DVec<2>(along.y, -along.x));
            body.planes.push_back({normal, dot(normal, loop[i])});
            body.through.push_back({(i + count - 1) % count, i});
        }
        bodies.push_back(std::move(body));
    }
    return smallest_rounded<2>(std::move(bodies), hull_points, limit, *frame);
}

Result<Hull2> limited_hull(std::span<const Vec2> points, const HullOptions& options) {
    if (options.added != nullptr) *options.added = 0;
    if (options.max_vertices != 0 && options.max_vertices < 3)
        return Problem{
            ProblemCode::bad_argument,
            "max_vertices is " + std::to_string(options.max_vertices) + ", and an area has 3 corners or more", 0};
    Result<Hull2> full = hull(points);
    if (!full || options.max_vertices == 0 || full->points.size() <= options.max_vertices) return full;
    std::optional<Hull2> result = outline_of(full->points, options.max_vertices, {});
    if (!result) return beyond_floats();
    if (options.added != nullptr) *options.added = std::max(0.0, size_of(*result) - size_of(*full));
    return *std::move(result);
}

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
    const double x = -normal[right] / normal[up], y = -normal[ahead] / normal[up], root = square_root(1 + x * x);
    Affine<2> to_plane;
    to_plane.column = {DVec<2>(root, 0), DVec<2>(x * y / root, square_root(1 + x * x + y * y) / root)};
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
