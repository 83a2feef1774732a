#include <abut/convex/farthest_point.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_grid.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace abut::detail {
namespace {

/// The nearest whole number to x >= 0, of two the larger. std::llround of MinGW-w64 rounds 1/2 - 2^-54 to 1.
std::int64_t nearest_whole(double x) {
    const double whole = std::floor(x);
    return static_cast<std::int64_t>(whole) + (x - whole >= 0.5 ? 1 : 0);
}

template <class Point>
HullGrid grid_of(std::span<const Point> points) {
    HullGrid result;
    const MinMax<3> box = min_max<3>(points);
    result.least = box.min;
    result.greatest = box.max;
    const double side = largest(box.sides());
    int exponent = 0;
    std::frexp(side, &exponent);  // side < 2^exponent
    result.step = std::ldexp(1.0, exponent - grid_bits);
    result.points.reserve(points.size());
    for (const Point& point : points) {
        const DVec<3> offset = (DVec<3>(point) - result.least) / result.step;
        const GridPoint rounded(nearest_whole(offset.x), nearest_whole(offset.y), nearest_whole(offset.z));
        for (int i = 0; i < 3; ++i)
            result.rounding[i] = std::max(result.rounding[i], std::abs(static_cast<double>(rounded[i]) - offset[i]));
        result.points.push_back(rounded);
    }
    result.tolerance = hull_tolerance * side / result.step;
    result.flatness = hull_flatness * side / result.step;
    return result;
}

}  // namespace

HullGrid on_grid(std::span<const Vec3> points) {
    return grid_of(points);
}

HullGrid on_grid(std::span<const DVec<3>> points) {
    return grid_of(points);
}

Spread spread_of(const HullGrid& grid, double tolerance) {
    const std::vector<GridPoint>& points = grid.points;
    const auto distance_from = [&](std::uint32_t from) {
        return [&points, from](const GridPoint& p) { return length(DVec<3>(p - points[from])); };
    };
    Spread result;
    std::uint32_t& a = result.points[0];
    std::uint32_t& b = result.points[1];
    std::uint32_t& c = result.points[2];
    std::uint32_t& d = result.points[3];
    a = farthest_of(points, distance_from(0));
    b = farthest_of(points, distance_from(a));
    result.rank = 1;

    const double base = length(DVec<3>(points[b] - points[a]));
    const auto twice_area = [&](const GridPoint& p) { return length(DVec<3>(grid_normal(points[a], points[b], p))); };
    c = farthest_of(points, twice_area);
    if (twice_area(points[c]) <= tolerance * base) return result;
    result.rank = 2;

    const GridPoint normal = grid_normal(points[a], points[b], points[c]);
    const auto volume = [&](const GridPoint& p) { return std::abs(grid_dot(normal, p - points[a])); };
    d = farthest_of(points, volume);
    if (volume(points[d]) > tolerance * length(DVec<3>(normal))) result.rank = 3;
    return result;
}

}  // namespace abut::detail
