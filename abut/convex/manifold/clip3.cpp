// Polyhedra as loops around their faces, and their half-spaces.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/manifold/clip_planes.hpp>

#include <numeric>
#include <utility>

namespace abut::detail {
namespace {

using Loop = std::vector<std::uint32_t>;

/// Adds both sides of a polygon; up to two corners need one loop.
void add_flat(ClipBody<3>& body, Loop loop) {
    if (loop.size() > 2) body.loops.emplace_back(loop.rbegin(), loop.rend());
    body.loops.insert(body.loops.begin(), std::move(loop));
}

ClipBody<3> box_body(const Affine<3>& place, const DVec<3>& half) {
    ClipBody<3> result;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        DVec<3> point = half;
        for (int i = 0; i < 3; ++i)
            if ((corner >> i & 1u) == 0) point[i] = -half[i];
        result.points.push_back(place.point(point));
    }
    std::array<std::uint32_t, 3> sides{};  // the bits of the axes of nonzero extent
    std::size_t rank = 0;
    for (std::uint32_t i = 0; i < 3; ++i)
        if (half[static_cast<int>(i)] > 0) sides[rank++] = 1u << i;
    if (rank == 3) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t across = sides[i], u = sides[(i + 1) % 3], v = sides[(i + 2) % 3];
            result.loops.push_back({0, v, u | v, u});
            result.loops.push_back({across, across | u, across | u | v, across | v});
        }
    } else {
        const std::uint32_t u = sides[0], v = sides[1];
        add_flat(result, rank == 2 ? Loop{0, u, u | v, v} : (rank == 1 ? Loop{0, u} : Loop{0}));
    }
    return result;
}

void add_loops(ClipBody<3>& body, std::span<const std::uint32_t> loops, std::span<const std::uint32_t> loop_ends) {
    std::size_t begin = 0;
    for (const std::uint32_t end : loop_ends) {
        body.loops.emplace_back(loops.begin() + static_cast<std::ptrdiff_t>(begin), loops.begin() + end);
        begin = end;
    }
}

/// The hull of the points rounded to floats, relative to their middle.
ClipBody<3> rebuilt(const std::vector<DVec<3>>& points) {
    const DVec<3> origin = min_max<3>(points).middle();
    std::vector<Vec3> rounded;
    for (const DVec<3>& point : points) rounded.push_back(to_float(point - origin));
    const Hull3 built = *hull(rounded);
    ClipBody<3> result;
    for (const Vec3& point : built.points) result.points.push_back(origin + DVec<3>(point));
    add_loops(result, built.loops, built.loop_ends);
    if (built.rank < 2) add_flat(result, built.rank == 1 ? Loop{0, 1} : Loop{0});
    return result;
}

/// The vector area of a loop, from a fan of triangles.
DVec<3> area_of(const ClipBody<3>& body, const Loop& loop) {
    const DVec<3> origin = body.points[loop[0]];
    DVec<3> twice(0.0);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        twice += cross(body.points[loop[i]] - origin, body.points[loop[i + 1]] - origin);
    return twice * 0.5;
}

double extent(const std::vector<DVec<3>>& points) {
    return 2 * length(farthest_from(points, points[0]) - points[0]);
}

/// The half-spaces of a box around nearly collinear points.
ClipPlanes<3> planes_around(const std::vector<DVec<3>>& points) {
    const DVec<3> end = farthest_from(points, points[0]);
    const DVec<3> along = normalized(farthest_from(points, end) - end), across = perpendicular(along);
    ClipPlanes<3> result;
    for (const DVec<3>& normal : {across, cross(along, across), along}) add_both_sides(result, points, normal);
    return result;
}

/// The half-spaces of both sides of a polygon, and those through its edges orthogonal to it.
ClipPlanes<3> planes_of_flat(const ClipBody<3>& body) {
    const Loop& loop = body.loops[0];
    const DVec<3> area = area_of(body, loop), up = normalized(area);
    const double reach = extent(body.points);
    const auto edge = [&](std::size_t i) { return body.points[loop[(i + 1) % loop.size()]] - body.points[loop[i]]; };
    double perimeter = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) perimeter += length(edge(i));
    if (length(area) <= clip_flatness * perimeter * reach) return planes_around(body.points);

    ClipPlanes<3> result;
    add_both_sides(result, body.points, up);
    double largest_depth = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        if (edge(i) == DVec<3>(0.0)) continue;
        result.planes.push_back(support_plane(body.points, normalized(cross(edge(i), up))));
        largest_depth =
            std::max(largest_depth, max_depth(result.planes.back(), body, {loop[i], loop[(i + 1) % loop.size()]}));
    }
    result.excess = excess(largest_depth, reach, length(area), perimeter);
    return result;
}

}  // namespace

template <>
ClipBody<3> clip_body(const Convex<3>& convex, const DVec<3>& origin) {
    Affine<3> place = convex.place;
    place.offset -= origin;
    if (convex.core == Core::box) return box_body(place, DVec<3>(convex.own[0]));
    ClipBody<3> result;
    for (std::uint32_t i = 0; i < convex.count; ++i)
        result.points.push_back(place.point(DVec<3>(convex.vertices()[i])));
    if (convex.facets != nullptr && !convex.facets->loop_ends.empty()) {
        add_loops(result, convex.facets->loops, convex.facets->loop_ends);
    } else if (convex.count <= 3) {
        Loop loop(convex.count);
        std::iota(loop.begin(), loop.end(), 0u);
        add_flat(result, std::move(loop));
    } else {
        result = rebuilt(result.points);
    }
    return result;
}

ClipPlanes<3> clip_planes(const ClipBody<3>& body) {
    if (body.loops[0].size() <= 2) return planes_around(body.points);
    if (body.loops.size() <= 2) return planes_of_flat(body);

    const DVec<3> middle = body.points[0];
    double volume = 0, area = 0;
    for (const Loop& loop : body.loops) {
        const DVec<3> face = area_of(body, loop);
        volume += dot(body.points[loop[0]] - middle, face) / 3;
        area += length(face);
    }
    const double reach = extent(body.points), inside = std::abs(volume);
    if (inside <= clip_flatness * area * reach) {
        const ClipBody<3> flat = rebuilt(body.points);
        if (flat.loops.size() <= 2) return clip_planes(flat);
    }
    const double outwards = volume < 0 ? -1 : 1;
    ClipPlanes<3> result;
    double largest_depth = 0;
    for (const Loop& loop : body.loops) {
        const DVec<3> face = area_of(body, loop);
        if (face == DVec<3>(0.0)) continue;
        result.planes.push_back(support_plane(body.points, normalized(face) * outwards));
        largest_depth = std::max(largest_depth, max_depth(result.planes.back(), body, loop));
    }
    result.excess = excess(largest_depth, reach, inside, area);
    return result;
}

}  // namespace abut::detail
