#pragma once

// A ray in double, and what is told of its hit. For .cpp files.

#include <abut/math/ray.hpp>
#include <abut/query/hit.hpp>
#include <abut/query/raycast_part.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

/// Without a direction it is as long as its origin.
template <int D>
DRay<D> beam_of(const Ray<D>& ray) {
    const DVec<D> direction(ray.direction);
    if (direction == DVec<D>(0.0)) return {DVec<D>(ray.origin), direction, 0};
    return {DVec<D>(ray.origin), unit(direction), static_cast<double>(ray.length)};
}

/// False where a number of it is NaN, or infinite that mustn't be.
template <int D>
bool can_be_asked(const Ray<D>& ray) {
    // Of floats as doubles no sum is infinite.
    double sum = 0;
    for (int i = 0; i < D; ++i) sum += static_cast<double>(ray.origin[i]) + static_cast<double>(ray.direction[i]);
    return std::abs(sum) <= std::numeric_limits<double>::max() && !std::isnan(ray.length);
}

template <int D>
inline void tell(const DRay<D>& beam, double along, const DVec<D>& normal, Hit<D>& hit) {
    hit.distance = static_cast<float>(along);
    hit.fraction = beam.length > 0 && beam.length <= static_cast<double>(std::numeric_limits<float>::max())
                       ? std::min(1.0f, static_cast<float>(along / beam.length))
                       : 0.0f;
    hit.point = to_float(beam.at(along));
    hit.normal = to_float(unit(normal));
}
template <int D>
void tell(const DRay<D>& beam, const PartHit<D>& first, Hit<D>& hit) {
    tell(beam, first.along, first.normal, hit);
    hit.started_inside = first.started_inside;
    hit.feature = first.feature;
}

}  // namespace abut
