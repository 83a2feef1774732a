// A hull of few corners in the plane.

#include <abut/convex/hull_input.hpp>
#include <abut/convex/limited_hull.hpp>
#include <abut/convex/outer_polygon.hpp>
#include <abut/convex/round_out.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <optional>
#include <string>

namespace abut {
namespace {

constexpr int most_margins = 40;

double area_of(std::span<const Vec2> loop) {
    double twice = 0;
    const DVec<2> origin(loop[0]);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        twice += cross(DVec<2>(loop[i]) - origin, DVec<2>(loop[i + 1]) - origin);
    return 0.5 * twice;
}

/// Whether no point is outside of a convex loop, exactly.
bool holds(std::span<const Vec2> loop, std::span<const Vec2> points) {
    for (std::size_t i = 0; i < loop.size(); ++i)
        for (const Vec2& point : points)
            if (orientation(loop[i], loop[i + 1 == loop.size() ? 0 : i + 1], point) < 0) return false;
    return true;
}

/// The corners as floats, each outside of its two edges by `margin`; nothing where one leaves their range.
std::optional<std::vector<Vec2>> rounded(std::span<const DVec<2>> loop, const DVec<2>& origin, double margin) {
    std::vector<Plane<2>> lines;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const DVec<2> along = loop[i + 1 == loop.size() ? 0 : i + 1] - loop[i];
        const DVec<2> normal = normalized(DVec<2>(along.y, -along.x));
        lines.push_back({normal, dot(normal, loop[i] + origin) + margin});
    }
    std::vector<Vec2> result;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Plane<2> both[] = {lines[i == 0 ? loop.size() - 1 : i - 1], lines[i]};
        const std::optional<Vec2> corner = rounded_out<2>(loop[i] + origin, both);
        if (!corner) return std::nullopt;
        result.push_back(*corner);
    }
    return result;
}

}  // namespace

std::optional<Hull2> outline_of(std::span<const Vec2> hull_points, std::size_t limit,
                                FunctionRef<bool(const Hull2&)> accept) {
    const DVec<2> origin(hull_points[0]);
    std::vector<DVec<2>> inner;
    for (const Vec2& point : hull_points) inner.push_back(DVec<2>(point) - origin);
    const std::vector<DVec<2>> outer = outer_polygon(inner, limit);
    const double side = extent<2>(hull_points);
    double margin = 0;
    for (int i = 0; i < most_margins; ++i) {
        const std::optional<std::vector<Vec2>> corners = rounded(outer, origin, margin);
        if (!corners) break;
        Result<Hull2> result = hull(*corners);
        if (result && result->rank == 2 && holds(result->points, hull_points) && accept(*result)) return *result;
        margin = margin == 0 ? 0x1p-50 * side : 4 * margin;
    }
    // Where its tips are so sharp that no float is in them.
    const std::vector<Vec2> corners = corners_of_box<2>(hull_points, limit);
    if (corners.empty()) return std::nullopt;
    Result<Hull2> result = hull(corners);
    if (!holds(result->points, hull_points) || !accept(*result)) return std::nullopt;
    return *result;
}

Result<Hull2> limited_hull(std::span<const Vec2> points, const HullOptions& options) {
    if (options.added != nullptr) *options.added = 0;
    if (options.max_vertices != 0 && options.max_vertices < 3)
        return Problem{
            ProblemCode::bad_argument,
            "max_vertices is " + std::to_string(options.max_vertices) + ", and an area has 3 corners or more", 0};
    Result<Hull2> full = hull(points);
    if (!full || options.max_vertices == 0 || full->points.size() <= options.max_vertices) return full;
    std::optional<Hull2> result = outline_of(full->points, options.max_vertices, [](const Hull2&) { return true; });
    if (!result) return beyond_floats();
    if (options.added != nullptr) *options.added = area_of(result->points) - area_of(full->points);
    return *std::move(result);
}

}  // namespace abut
