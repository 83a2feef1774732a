#pragma once

// A bounding ball of points: if two bounding balls are disjoint, so are their contents.

#include <abut/math/aabb.hpp>
#include <abut/math/dvec.hpp>

#include <span>

namespace abut::detail {

template <int D>
struct BoundingBall {
    DVec<D> center{0.0};
    double radius = 0;
};

/// The ball through the corners of a box; right to rounding.
template <int D>
BoundingBall<D> ball_around(const Aabb<D>& box) {
    const DVec<D> low(box.min), high(box.max);
    return {(low + high) * 0.5, 0.5 * length(high - low)};
}

/// Centred on the middle of the bounding box; right to rounding. There is at least one point.
template <int D>
BoundingBall<D> ball_around(std::span<const Vec<D>> points) {
    BoundingBall<D> result{min_max<D>(points).middle(), 0};
    for (const Vec<D>& point : points) result.radius = std::max(result.radius, length(DVec<D>(point) - result.center));
    return result;
}

}  // namespace abut::detail
