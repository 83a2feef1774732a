// The hull in 2D: a monotone chain with exact orientation tests.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_columns.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>

namespace abut::detail {
namespace {

/// Twice the area of the triangle abc, in double.
double area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return cross(DVec<2>(b) - DVec<2>(a), DVec<2>(c) - DVec<2>(a));
}

Vec2 farthest_from(const Vec2& from, std::span<const Vec2> points) {
    return *std::max_element(points.begin(), points.end(), [&](const Vec2& a, const Vec2& b) {
        return length_squared(DVec<2>(a) - DVec<2>(from)) < length_squared(DVec<2>(b) - DVec<2>(from));
    });
}

/// Reduces a loop no wider than the tolerance to its longest segment.
void flatten(std::vector<Vec2>& loop) {
    Vec2 a = farthest_from(loop[0], loop), b = farthest_from(a, loop);
    if (less(b, a)) std::swap(a, b);
    const auto [right, left] = std::minmax_element(
        loop.begin(), loop.end(), [&](const Vec2& p, const Vec2& q) { return area(a, b, p) < area(a, b, q); });
    const double length_ab = length(DVec<2>(b) - DVec<2>(a));
    if ((area(a, b, *left) - area(a, b, *right)) / length_ab <= hull_tolerance * extent<2>(loop)) loop = {a, b};
}

}  // namespace

std::vector<std::uint32_t> hull_loop(std::span<const Vec2> points) {
    const std::vector<HullColumn> columns = hull_columns(points);
    const NumberedPoint &least = columns.front().lowest, &greatest = columns.back().highest;
    if (least.point == greatest.point) return {least.number};

    // The lower chain from the least point to the greatest, then the upper chain back. Each omits its last point, where
    // the other begins.
    std::vector<NumberedPoint> loop{least};
    std::size_t first = 0;
    const auto append = [&](const NumberedPoint& next) {
        if (next.number == loop.back().number) return;
        while (loop.size() >= first + 2 && orientation(loop[loop.size() - 2].point, loop.back().point, next.point) <= 0)
            loop.pop_back();
        loop.push_back(next);
    };
    for (const HullColumn& column : columns) append(column.lowest);
    append(greatest);
    first = loop.size() - 1;
    for (auto column = columns.rbegin(); column != columns.rend(); ++column) append(column->highest);
    append(least);
    loop.pop_back();
    std::vector<std::uint32_t> result;
    result.reserve(loop.size());
    for (const NumberedPoint& corner : loop) result.push_back(corner.number);
    return result;
}

Result<Hull2> hull(std::span<const Vec2> points) {
    if (auto problem = problem_with(points)) return *problem;
    Hull2 result;
    for (const std::uint32_t i : hull_loop(points)) result.points.push_back(without_negative_zero(points[i]));
    if (result.points.size() > 2) flatten(result.points);
    result.rank = static_cast<int>(std::min<std::size_t>(result.points.size() - 1, 2));
    return result;
}

}  // namespace abut::detail
