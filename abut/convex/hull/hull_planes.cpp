// The support point along a face's normal, on the triangles before they were merged, because that surface is exactly
// convex.

#include <abut/convex/hull/hill_climb.hpp>
#include <abut/convex/hull/hull_planes.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {
namespace {

/// Finds the highest of the points of a surface along a direction, exactly.
class HighestPoint {
public:
    HighestPoint(std::span<const GridPoint> points, const TriangleSurface& surface)
        : points_(points.begin(), points.end()), hill_climb_(points.size(), surface) {}

    /// Starts from some corners of the surface.
    std::uint32_t along(const Vec3& direction, std::span<const std::uint32_t> start) const {
        const DVec<3> n(direction);
        std::uint32_t best = start[0];
        const auto better = [&](std::uint32_t point) {
            const DVec<3> offset = points_[point] - points_[best];
            // The products are exact: 24 + 29 bits. Their sums, below 2^30, have an error of at most 2^-22.
            const double rise = dot(n, offset);
            const bool result =
                rise > -0x1p-20 && (rise > 0x1p-20 || sign_of_sum(n.x * offset.x, n.y * offset.y, n.z * offset.z) > 0);
            if (result) best = point;
            return result;
        };
        for (const std::uint32_t point : start) better(point);
        return hill_climb_.best(best, better);
    }

private:
    std::vector<DVec<3>> points_;
    HillClimb hill_climb_;
};

/// How much higher along the normal an input point can be than the support point of the surface. It sums the distance
/// of points left out, the rounding of both to the grid, and the rounding of double in that distance (2^-20 of a step)
/// and in both dot products (two sums each).
double rounding_error(const Vec3& normal, const HullGrid& grid, double left_out) {
    const DVec<3> n(normal);
    double steps = left_out * length(n), magnitude = 0;
    for (int i = 0; i < 3; ++i) {
        steps += std::abs(n[i]) * (2 * grid.rounding[i] + 0x1p-20);
        magnitude += std::abs(n[i]) * std::max(std::abs(grid.least[i]), std::abs(grid.greatest[i]));
    }
    return steps * grid.step + 0x1p-50 * magnitude;
}

}  // namespace

std::vector<double> plane_offsets(const HullFaces& faces, std::span<const Vec3> points, const HullGrid& grid,
                                  const TriangleSurface& surface) {
    const HighestPoint highest_point(grid.points, surface);
    std::vector<double> result;
    result.reserve(faces.normals.size());
    for (std::size_t face = 0; face < faces.normals.size(); ++face) {
        const Vec3& normal = faces.normals[face];
        const DVec<3> n(normal);
        if ((n.x != 0) + (n.y != 0) + (n.z != 0) == 1) {
            const auto far_side = [&](int i) { return n[i] > 0 ? grid.greatest[i] : grid.least[i]; };
            result.push_back(dot(n, DVec<3>(far_side(0), far_side(1), far_side(2))));
        } else {
            const Vec3& highest = points[highest_point.along(normal, faces.loop(face))];
            result.push_back(dot(n, DVec<3>(highest)) + rounding_error(normal, grid, surface.left_out));
        }
    }
    return result;
}

}  // namespace abut::detail
