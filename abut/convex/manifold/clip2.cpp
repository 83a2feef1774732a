// Polygons as loops, and the half-planes of their edges.

#include <abut/convex/manifold/clip_planes.hpp>

#include <numeric>

namespace abut::detail {
namespace {

/// The half-planes of a box around nearly collinear points.
ClipPlanes<2> planes_around(const std::vector<DVec<2>>& points) {
    const DVec<2> end = farthest_from(points, points[0]);
    const DVec<2> along = normalized(farthest_from(points, end) - end);
    ClipPlanes<2> result;
    add_both_sides(result, points, perpendicular(along));
    add_both_sides(result, points, along);
    return result;
}

}  // namespace

template <>
ClipBody<2> clip_body(const Convex<2>& convex, const DVec<2>& origin) {
    Affine<2> place = convex.place;
    place.offset -= origin;
    ClipBody<2> result;
    if (convex.core == Core::box) {
        const DVec<2> half(convex.own[0]);
        for (const DVec<2>& corner : {-half, DVec<2>(half.x, -half.y), half, DVec<2>(-half.x, half.y)})
            result.points.push_back(place.point(corner));
    } else {
        for (std::uint32_t i = 0; i < convex.count; ++i)
            result.points.push_back(place.point(DVec<2>(convex.vertices()[i])));
    }
    std::vector<std::uint32_t>& loop = result.loops.emplace_back(result.points.size());
    std::iota(loop.begin(), loop.end(), 0u);
    return result;
}

ClipPlanes<2> clip_planes(const ClipBody<2>& body) {
    const std::vector<DVec<2>>& points = body.points;
    const std::vector<std::uint32_t>& loop = body.loops[0];
    double twice_area = 0, perimeter = 0;
    const auto edge = [&](std::size_t i) { return points[loop[(i + 1) % loop.size()]] - points[loop[i]]; };
    for (std::size_t i = 0; i < loop.size(); ++i) {
        twice_area += cross(points[loop[i]] - points[loop[0]], edge(i));
        perimeter += length(edge(i));
    }
    const double extent = perimeter / 2, area = std::abs(twice_area) / 2;
    if (area <= clip_flatness * perimeter * extent) return planes_around(points);

    const double clockwise = twice_area < 0 ? -1 : 1;
    ClipPlanes<2> result;
    double largest_depth = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        if (edge(i) == DVec<2>(0.0)) continue;
        result.planes.push_back(support_plane(points, -perpendicular(edge(i)) * clockwise));
        largest_depth =
            std::max(largest_depth, max_depth(result.planes.back(), body, {loop[i], loop[(i + 1) % loop.size()]}));
    }
    result.excess = excess(largest_depth, extent, area, perimeter);
    return result;
}

}  // namespace abut::detail
