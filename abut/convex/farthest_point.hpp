#pragma once

// The support point of many points, where searches on polytopes spend most of their time.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>

namespace abut::detail {

/// The index of the point with the largest dot product, evaluated in double as x + y (+ z); of several the lowest.
/// There is at least one point. The evaluation uses SIMD, and the result is the same on every target.
std::uint32_t farthest_point(std::span<const Vec2> points, const DVec<2>& direction);
std::uint32_t farthest_point(std::span<const Vec3> points, const DVec<3>& direction);

/// The index of the first point with the greatest `measure`. There is at least one point.
template <class Points, class Measure>
std::uint32_t farthest_of(const Points& points, Measure measure) {
    std::uint32_t best = 0;
    double maximum = measure(points[0]);
    for (std::uint32_t i = 1; i < points.size(); ++i) {
        const double value = measure(points[i]);
        if (value > maximum) {
            maximum = value;
            best = i;
        }
    }
    return best;
}

}  // namespace abut::detail
