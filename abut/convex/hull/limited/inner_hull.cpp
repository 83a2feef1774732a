#include <abut/convex/farthest_point.hpp>
#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/convex/hull/limited/inner_hull.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace abut::detail {
namespace {

constexpr int max_moves = 8;

/// Farthest point sampling from `first`.
std::vector<Vec3> far_apart(std::span<const Vec3> points, std::size_t count, const Vec3& first) {
    std::vector<Vec3> result{first};
    std::vector<double> squares(points.size(), std::numeric_limits<double>::max());
    while (result.size() < count) {
        const DVec<3> last(result.back());
        for (std::size_t i = 0; i < points.size(); ++i)
            squares[i] = std::min(squares[i], length_squared(DVec<3>(points[i]) - last));
        result.push_back(points[farthest_of(squares, [](double square) { return square; })]);
    }
    return result;
}

/// One per corner: the gradient of the volume by its position, for constant faces.
std::vector<DVec<3>> slopes(const Hull3& hull) {
    std::vector<DVec<3>> result(hull.points.size(), DVec<3>(0.0));
    const std::vector<std::uint32_t> triangles = triangles_of(hull.loops, hull.loop_ends);
    for (std::size_t i = 0; i < triangles.size(); i += 3)
        for (std::size_t j = 0; j < 3; ++j)
            result[triangles[i + j]] += cross(DVec<3>(hull.points[triangles[i + (j + 1) % 3]] - hull.points[0]),
                                              DVec<3>(hull.points[triangles[i + (j + 2) % 3]] - hull.points[0]));
    return result;
}

}  // namespace

Hull3 inner_hull(std::span<const Vec3> points, std::size_t count, const Vec3& first) {
    Hull3 result = *hull(far_apart(points, count, first));
    for (int round = 0; round < max_moves && result.rank == 3; ++round) {
        const std::vector<DVec<3>> directions = slopes(result);
        std::vector<Vec3> moved;
        for (const DVec<3>& direction : directions) moved.push_back(points[farthest_point(points, direction)]);
        Hull3 next = *hull(moved);
        if (!(next.volume > result.volume)) break;
        result = std::move(next);
    }
    return result;
}

}  // namespace abut::detail
