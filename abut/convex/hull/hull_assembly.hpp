#pragma once

// Assembles a hull from its faces.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_faces.hpp>
#include <abut/convex/hull/hull_grid.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut::detail {

/// The faces in the lexicographical order of their loops, each from its lowest point number.
HullFaces in_order(const HullFaces& faces, std::size_t point_count);

/// Replaces point numbers by 0, 1, ... in the order of the points, and returns those that are in use.
template <class Point>
std::vector<Point> points_in_use(std::span<const Point> points, std::vector<std::uint32_t>& numbers) {
    std::vector<std::uint32_t> new_number(points.size(), 0);
    for (const std::uint32_t point : numbers) new_number[point] = 1;
    std::vector<Point> result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (new_number[i] == 0) continue;
        new_number[i] = static_cast<std::uint32_t>(result.size());
        result.push_back(points[i]);
    }
    for (std::uint32_t& point : numbers) point = new_number[point];
    return result;
}

/// Moves the faces to `result` with the points of their loops, renumbered.
void take_faces(Hull3& result, std::span<const Vec3> points, HullFaces faces);

/// Sets volume, area and centroid from triangles that cover the surface (three corners each). The triangles are exact;
/// merged faces aren't quite flat, which would change the volume of a thin body. On the grid volumes are exact but for
/// one rounding.
void measure(Hull3& hull, const HullGrid& grid, std::span<const std::uint32_t> triangles);
void measure(Hull3& hull, std::span<const Vec3> points, std::span<const std::uint32_t> triangles);

/// The unit vector area of a loop.
Vec3 normal_of_loop(std::span<const Vec3> points, std::span<const std::uint32_t> loop);

/// The corners of triangles that cover the faces.
std::vector<std::uint32_t> triangles_of(std::span<const std::uint32_t> loops, std::span<const std::uint32_t> loop_ends);

/// Two faces, back to back, around coplanar points: their 2D hull along the axis nearest to the normal.
HullFaces flat_faces(std::span<const Vec3> points, const DVec<3>& normal);

/// The flat hull of sorted, different points. The offsets bound the points `inside` as well.
Hull3 flat_hull(std::span<const Vec3> points, const DVec<3>& normal, std::span<const Vec3> inside);

/// An upper bound of dot(normal, p) over all points, evaluated exactly or in double; along an axis it is the maximum.
double offset_above(const Vec3& normal, std::span<const Vec3> points);

}  // namespace abut::detail
