// Hulls with a vertex limit in 2D.

#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/convex/hull/limited/outer_polygon.hpp>
#include <abut/convex/hull/limited/round_outwards.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
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
    if (options.added != nullptr) *options.added = size_of(*result) - size_of(*full);
    return *std::move(result);
}

}  // namespace abut::detail
