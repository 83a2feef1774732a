#include <abut/convex/hull.hpp>
#include <abut/convex/hull_grid.hpp>
#include <abut/convex/hull_input.hpp>

#include <algorithm>
#include <cmath>

namespace abut {

Grid on_grid(std::span<const Vec3> points) {
    Grid result;
    result.least = least_corner<3>(points);
    result.greatest = greatest_corner<3>(points);
    const double side = extent<3>(points);
    int exponent = 0;
    std::frexp(side, &exponent);  // side < 2^exponent
    result.step = std::ldexp(1.0, exponent - grid_bits);
    result.points.reserve(points.size());
    for (const Vec3& point : points) {
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

}  // namespace abut
