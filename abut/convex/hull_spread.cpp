#include <abut/convex/farthest_of.hpp>
#include <abut/convex/hull_spread.hpp>
#include <abut/math/dvec.hpp>

#include <cmath>

namespace abut {

Spread spread_of(const Grid& grid, double tolerance) {
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

}  // namespace abut
