#pragma once

// A ray in double, and the conversion of its hit to the public answer. For .cpp files.

#include <abut/math/ray.hpp>
#include <abut/query/detail/raycast/part_hit.hpp>
#include <abut/query/hit.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

/// A ray without direction has length 0.
template <int D>
DRay<D> to_dray(const Ray<D>& ray) {
    const DVec<D> direction(ray.direction);
    if (direction == DVec<D>(0.0)) return {DVec<D>(ray.origin), direction, 0};
    return {DVec<D>(ray.origin), unit(direction), static_cast<double>(ray.length)};
}

template <int D>
inline void write_hit(const DRay<D>& beam, double along, const DVec<D>& normal, Hit<D>& hit) {
    hit.distance = static_cast<float>(along);
    hit.fraction = beam.length > 0 && beam.length <= static_cast<double>(std::numeric_limits<float>::max())
                       ? std::min(1.0f, static_cast<float>(along / beam.length))
                       : 0.0f;
    hit.point = to_float(beam.at(along));
    hit.normal = to_float(unit(normal));
}
template <int D>
void write_hit(const DRay<D>& beam, const PartHit<D>& first, Hit<D>& hit) {
    write_hit(beam, first.along, first.normal, hit);
    hit.started_inside = first.started_inside;
    hit.feature = first.feature;
}

}  // namespace abut
