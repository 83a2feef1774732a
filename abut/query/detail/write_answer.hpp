#pragma once

// Conversion of the engines' answers, in double, to the public answers. For .cpp files.

#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/detail/pair_dispatch.hpp>

namespace abut::detail {

template <int D>
void write(const SignedDistance<D>& distance, Closest<D>& result) {
    result.distance = static_cast<float>(distance.distance);
    result.normal = to_float(distance.normal);
    result.on_a = to_float(distance.on_a);
    result.on_b = to_float(distance.on_b());
}

/// Its normal is a unit vector all the same.
template <int D>
Contact<D> no_contact() {
    Contact<D> result;
    result.normal[0] = 1;
    return result;
}

template <int D>
void write(const SignedDistance<D>& distance, const Manifold<D>& manifold, Contact<D>& result) {
    result.normal = to_float(distance.normal);
    result.depth = static_cast<float>(-distance.distance);
    result.points.clear();
    for (std::size_t i = 0; i < manifold.count; ++i) {
        const ManifoldPoint<D>& point = manifold.points[i];
        result.points.push_back({to_float(point.position), static_cast<float>(point.depth), point.feature});
    }
}

}  // namespace abut::detail
