#pragma once

// Checks that every query of two shapes returns finite numbers: no NaN, no infinity, normals of length 1.

#include <abut/math/ray.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace abut::oracle {

template <int D>
bool is_direction(const Vec<D>& v) {
    double squared = 0;
    for (int a = 0; a < D; ++a) squared += static_cast<double>(v[a]) * static_cast<double>(v[a]);
    return std::abs(squared - 1) < 1e-4;
}

/// The distance may be infinite: a composite shape without parts, or a field without a surface, has no closest point.
template <int D>
bool is_finite_answer(const Closest<D>& found) {
    return found.distance > -std::numeric_limits<float>::infinity() && is_direction<D>(found.normal) &&
           detail::is_finite<D>(found.on_a) && detail::is_finite<D>(found.on_b);
}
template <int D>
bool is_finite_answer(const Contact<D>& found) {
    if (!found) return true;
    bool result = std::isfinite(found.depth) && is_direction<D>(found.normal);
    for (const ContactPoint<D>& point : found.points)
        result = result && std::isfinite(point.depth) && detail::is_finite<D>(point.position);
    return result;
}
template <int D>
bool is_finite_answer(const std::optional<Hit<D>>& hit) {
    return !hit || (hit->fraction >= 0 && hit->fraction <= 1 && hit->distance >= 0 && std::isfinite(hit->distance) &&
                    detail::is_finite<D>(hit->point) && is_direction<D>(hit->normal));
}

/// The name of the first query whose answer isn't finite; null if all are.
template <class A, class B, int D>
const char* non_finite_pair_query(const A& a, const B& b, const glm::vec<D, float>& motion) {
    static_cast<void>(overlaps(a, b));
    if (!is_finite_answer<D>(closest(a, b))) return "closest";
    if (!is_finite_answer<D>(contact(a, b))) return "contact";
    if (!is_finite_answer<D>(sweep(a, motion, b))) return "sweep";
    return nullptr;
}

template <class S, int D>
const char* non_finite_shape_query(const S& shape, const glm::vec<D, float>& from, const glm::vec<D, float>& to) {
    if (!is_finite_answer<D>(closest(shape, from))) return "closest to a point";
    if (!is_finite_answer<D>(raycast(Ray<D>::between(from, to), shape))) return "raycast";
    static_cast<void>(contains(shape, from));
    return nullptr;
}

}  // namespace abut::oracle
