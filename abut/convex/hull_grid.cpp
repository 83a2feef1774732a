#include <abut/convex/hull.hpp>
#include <abut/convex/hull_grid.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>

namespace abut {
namespace {

template <class Point>
Grid grid_of(std::span<const Point> points) {
    Grid result;
    result.least = result.greatest = DVec<3>(points[0]);
    for (const Point& point : points)
        for (int i = 0; i < 3; ++i) {
            result.least[i] = std::min(result.least[i], static_cast<double>(point[i]));
            result.greatest[i] = std::max(result.greatest[i], static_cast<double>(point[i]));
        }
    const double side = largest(result.greatest - result.least);
    int exponent = 0;
    std::frexp(side, &exponent);  // side < 2^exponent
    result.step = std::ldexp(1.0, exponent - grid_bits);
    result.points.reserve(points.size());
    for (const Point& point : points) {
        const DVec<3> offset = (DVec<3>(point) - result.least) / result.step;
        const GridPoint rounded(std::llround(offset.x), std::llround(offset.y), std::llround(offset.z));
        for (int i = 0; i < 3; ++i)
            result.rounding[i] = std::max(result.rounding[i], std::abs(static_cast<double>(rounded[i]) - offset[i]));
        result.points.push_back(rounded);
    }
    result.tolerance = hull_tolerance * side / result.step;
    result.flatness = hull_flatness * side / result.step;
    return result;
}

}  // namespace

Grid on_grid(std::span<const Vec3> points) {
    return grid_of(points);
}

Grid on_grid(std::span<const DVec<3>> points) {
    return grid_of(points);
}

}  // namespace abut
