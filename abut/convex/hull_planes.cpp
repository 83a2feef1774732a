// The highest point along a face's normal, found by walking uphill on the surface before its triangles were joined:
// that one is convex exactly, so where no neighbour is higher nothing is.

#include <abut/convex/hull_planes.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace abut {
namespace {

class Climb {
public:
    Climb(std::span<const GridPoint> points, const TriangleSurface& surface)
        : points_(points.begin(), points.end()), neighbors_(surface.origin.size()), neighbors_end_(points.size() + 1) {
        for (const std::uint32_t from : surface.origin) ++neighbors_end_[from + 1];
        std::partial_sum(neighbors_end_.begin(), neighbors_end_.end(), neighbors_end_.begin());
        for (std::uint32_t h = 0; h < surface.origin.size(); ++h)
            neighbors_[neighbors_end_[surface.origin[h]]++] = surface.origin[following(h)];
    }

    /// The point of the surface that is highest along the direction, starting from corners of it.
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
            const DVec<3> way = points_[point] - points_[best];
            // The products are exact: 24 + 29 bits. Their sums, below 2^30, are off by 2^-22 at most.
            const double rise = dot(n, way);
            if (rise > -0x1p-20 && (rise > 0x1p-20 || sign_of_sum(n.x * way.x, n.y * way.y, n.z * way.z) > 0))
                best = point;
        }
        return best;
    }

    std::vector<DVec<3>> points_;
    std::vector<std::uint32_t> neighbors_;      ///< of all points, one after the other
    std::vector<std::uint32_t> neighbors_end_;  ///< one a point: where its own end in `neighbors_`
};

/// How much higher along the normal an input point can be than the highest point of the surface: by what was left out,
/// by the rounding of both to the grid, and by that of double in the distances to what was left out (2^-20 of a step)
/// and in both their dot products (two sums each).
double doubt(const Vec3& normal, const Grid& grid, double left_out) {
    const DVec<3> n(normal);
    double steps = left_out * length(n), magnitude = 0;
    for (int i = 0; i < 3; ++i) {
        steps += std::abs(n[i]) * (2 * grid.rounding[i] + 0x1p-20);
        magnitude += std::abs(n[i]) * std::max(std::abs(grid.least[i]), std::abs(grid.greatest[i]));
    }
    return steps * grid.step + 0x1p-50 * magnitude;
}

}  // namespace

std::vector<double> plane_offsets(const HullFaces& faces, std::span<const Vec3> points, const Grid& grid,
                                  const TriangleSurface& surface) {
    const Climb climb(grid.points, surface);
    std::vector<double> result;
    result.reserve(faces.normals.size());
    for (std::size_t face = 0; face < faces.normals.size(); ++face) {
        const Vec3& normal = faces.normals[face];
        const DVec<3> n(normal);
        if ((n.x != 0) + (n.y != 0) + (n.z != 0) == 1) {
            const auto far_side = [&](int i) { return n[i] > 0 ? grid.greatest[i] : grid.least[i]; };
            result.push_back(dot(n, DVec<3>(far_side(0), far_side(1), far_side(2))));
        } else {
            const Vec3& highest = points[climb.highest(normal, faces.loop(face))];
            result.push_back(dot(n, DVec<3>(highest)) + doubt(normal, grid, surface.left_out));
        }
    }
    return result;
}

}  // namespace abut
