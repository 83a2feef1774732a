#pragma once

// Half-spaces around points, for clipping in 2D and 3D. For .cpp files.

#include <abut/convex/manifold/clip.hpp>

namespace abut::detail {

/// A body is flat if its measure is no more than this times its boundary's and its extent. Floats have no such bodies;
/// only a stretched placement makes them.
inline constexpr double clip_flatness = 1e-9;

template <int D>
const DVec<D>& farthest_from(const std::vector<DVec<D>>& points, const DVec<D>& from) {
    return *std::max_element(points.begin(), points.end(), [&](const DVec<D>& p, const DVec<D>& q) {
        return length_squared(p - from) < length_squared(q - from);
    });
}

/// The smallest half-space along a normal that contains all points.
template <int D>
ClipPlane<D> support_plane(const std::vector<DVec<D>>& points, const DVec<D>& normal) {
    double offset = dot(normal, points[0]);
    for (const DVec<D>& point : points) offset = std::max(offset, dot(normal, point));
    return {normal, offset};
}

template <int D>
void add_both_sides(ClipPlanes<D>& result, const std::vector<DVec<D>>& points, const DVec<D>& normal) {
    result.planes.push_back(support_plane(points, normal));
    result.planes.push_back(support_plane(points, -normal));
}

/// The maximum depth of a loop's corners behind a plane.
template <int D>
double max_depth(const ClipPlane<D>& plane, const ClipBody<D>& body, const std::vector<std::uint32_t>& loop) {
    double lowest = plane.offset;
    for (const std::uint32_t i : loop) lowest = std::min(lowest, dot(plane.normal, body.points[i]));
    return plane.offset - lowest;
}

/// If all of the boundary lies no deeper than `max_depth` behind the planes, then their intersection is no farther from
/// it than
///
///     max_depth * extent / radius        of a ball inside, and radius >= inside / outside,
///
/// along a line from the middle of the ball through the boundary to its plane.
inline double excess(double max_depth, double extent, double inside, double outside) {
    return max_depth * extent * outside / inside;
}

}  // namespace abut::detail
