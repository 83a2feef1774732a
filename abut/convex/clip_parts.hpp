#pragma once

// Half-spaces that hold points: what clipping takes in both dimensions. For .cpp files.

#include <abut/convex/clip.hpp>

namespace abut {

/// A body whose inside measures no more than this times its outside and its extent is flat: far below what floats can
/// hold, so that only stretching gets there.
inline constexpr double clip_flatness = 1e-9;

template <int D>
const DVec<D>& farthest_from(const std::vector<DVec<D>>& points, const DVec<D>& from) {
    return *std::max_element(points.begin(), points.end(), [&](const DVec<D>& p, const DVec<D>& q) {
        return length_squared(p - from) < length_squared(q - from);
    });
}

/// The least half-space along a normal that holds all points.
template <int D>
ClipPlane<D> support_plane(const std::vector<DVec<D>>& points, const DVec<D>& normal) {
    double most = dot(normal, points[0]);
    for (const DVec<D>& point : points) most = std::max(most, dot(normal, point));
    return {normal, most};
}

template <int D>
void add_both_sides(ClipPlanes<D>& result, const std::vector<DVec<D>>& points, const DVec<D>& normal) {
    result.planes.push_back(support_plane(points, normal));
    result.planes.push_back(support_plane(points, -normal));
}

/// How far the corners of a loop lie behind a plane at most.
template <int D>
double slack(const ClipPlane<D>& plane, const ClipBody<D>& body, const std::vector<std::uint32_t>& loop) {
    double least = plane.offset;
    for (const std::uint32_t i : loop) least = std::min(least, dot(plane.normal, body.points[i]));
    return plane.offset - least;
}

/// If all of the outside lies no farther than `slack` behind the planes, then they are nowhere farther from it than
///
///     slack * extent / radius        of a ball inside, and radius >= inside / outside,
///
/// where a line from the middle of the ball through the outside meets its plane.
inline double excess(double slack, double extent, double inside, double outside) {
    return slack * extent * outside / inside;
}

}  // namespace abut
