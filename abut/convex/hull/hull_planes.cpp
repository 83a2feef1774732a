// The support point along a face's normal, by hill climbing on the triangles before they were merged. That surface is
// exactly convex, so a local maximum is the maximum.

#include <abut/convex/hull/hull_planes.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace abut::detail {
namespace {

class HillClimb {
public:
    HillClimb(std::span<const GridPoint> points, const TriangleSurface& surface)
        : points_(points.begin(), points.end()), neighbors_(surface.origin.size()), neighbors_end_(points.size() + 1) {
        for (const std::uint32_t from : surface.origin) ++neighbors_end_[from + 1];
        std::partial_sum(neighbors_end_.begin(), neighbors_end_.end(), neighbors_end_.begin());
        for (std::uint32_t h = 0; h < surface.origin.size(); ++h)
            neighbors_[neighbors_end_[surface.origin[h]]++] = surface.origin[following(h)];
    }

    /// The support point of the surface, starting from some of its corners.
    std::uint32_t highest(const Vec3& direction, std::span<const std::uint32_t> start) const {
        std::uint32_t best = highest_of(direction, start[0], start);
        for (;;) {
            const std::uint32_t next = highest_of(direction, best, neighbors(best));
            if (next == best) return best;
            best = next;
        }
    }

private:
    std::span<const std::uint32_t> neighbors(std::uint32_t point) const {
        const std::uint32_t begin = point == 0 ? 0 : neighbors_end_[point - 1];
        return std::span(neighbors_).subspan(begin, neighbors_end_[point] - begin);
    }

    std::uint32_t highest_of(const Vec3& direction, std::uint32_t best, std::span<const std::uint32_t> others) const {
        const DVec<3> n(direction);
        for (const std::uint32_t point : others) {
            const DVec<3> offset = points_[point] - points_[best];
            // The products are exact: 24 + 29 bits. Their sums, below 2^30, have an error of at most 2^-22.
            const double rise = dot(n, offset);
            if (rise > -0x1p-20 && (rise > 0x1p-20 || sign_of_sum(n.x * offset.x, n.y * offset.y, n.z * offset.z) > 0))
                best = point;
        }
        return best;
    }

    std::vector<DVec<3>> points_;
    std::vector<std::uint32_t> neighbors_;      ///< of all points, one after the other
    std::vector<std::uint32_t> neighbors_end_;  ///< one per point: the end of its neighbors in `neighbors_`
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
    const HillClimb hill_climb(grid.points, surface);
    std::vector<double> result;
    result.reserve(faces.normals.size());
    for (std::size_t face = 0; face < faces.normals.size(); ++face) {
        const Vec3& normal = faces.normals[face];
        const DVec<3> n(normal);
        if ((n.x != 0) + (n.y != 0) + (n.z != 0) == 1) {
            const auto far_side = [&](int i) { return n[i] > 0 ? grid.greatest[i] : grid.least[i]; };
            result.push_back(dot(n, DVec<3>(far_side(0), far_side(1), far_side(2))));
        } else {
            const Vec3& highest = points[hill_climb.highest(normal, faces.loop(face))];
            result.push_back(dot(n, DVec<3>(highest)) + rounding_error(normal, grid, surface.left_out));
        }
    }
    return result;
}

}  // namespace abut::detail
