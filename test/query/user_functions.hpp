#pragma once

// User-defined distance functions: some have the form of library shapes, one does not.

#include <abut/math/aabb.hpp>
#include <abut/math/detail/sin_cos.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/view/distance_function.hpp>

namespace abut::users {

using detail::dot;
using detail::DVec;
using detail::length;
using detail::length_squared;
using detail::normalized;
using detail::perpendicular;
using detail::to_float;

/// A ball as a distance function.
template <int D>
struct Blob {
    Vec<D> center{};
    float radius = 1;

    Ball<D> twin() const { return {center, radius}; }
};
template <int D>
Aabb<D> bounds(const Blob<D>& blob) {
    return {blob.center - Vec<D>(blob.radius), blob.center + Vec<D>(blob.radius)};
}
template <int D>
float signed_distance(const Blob<D>& blob, const Vec<D>& point) {
    return static_cast<float>(length(DVec<D>(point) - DVec<D>(blob.center)) - static_cast<double>(blob.radius));
}

/// A rounded box around the origin.
template <int D>
struct Brick {
    Vec<D> half{1.0f};

    Box<D> twin() const { return {Vec<D>(0.0f), half}; }
};
template <int D>
Aabb<D> bounds(const Brick<D>& brick) {
    return {-brick.half, brick.half};
}
template <int D>
float signed_distance(const Brick<D>& brick, const Vec<D>& point) {
    DVec<D> beyond(0.0);
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < D; ++i) {
        const double over = std::abs(static_cast<double>(point[i])) - static_cast<double>(brick.half[i]);
        most = std::max(most, over);
        beyond[i] = std::max(over, 0.0);
    }
    return static_cast<float>(most > 0 ? length(beyond) : most);
}

/// A capsule that also returns the direction.
template <int D>
struct Pill {
    Vec<D> a{}, b{};
    float radius = 1;

    Capsule<D> twin() const { return {a, b, radius}; }
};
template <int D>
Aabb<D> bounds(const Pill<D>& pill) {
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        result.min[i] = std::min(pill.a[i], pill.b[i]) - pill.radius;
        result.max[i] = std::max(pill.a[i], pill.b[i]) + pill.radius;
    }
    return result;
}
template <int D>
FieldSample<D> distance_sample(const Pill<D>& pill, const Vec<D>& point) {
    const DVec<D> a(pill.a), displacement = DVec<D>(pill.b) - a, from = DVec<D>(point) - a;
    const double along = std::clamp(dot(from, displacement) / length_squared(displacement), 0.0, 1.0);
    const DVec<D> out = from - displacement * along;
    return {static_cast<float>(length(out) - static_cast<double>(pill.radius)),
            to_float(normalized(out, perpendicular(displacement)))};
}
template <int D>
float signed_distance(const Pill<D>& pill, const Vec<D>& point) {
    return distance_sample(pill, point).distance;
}

/// Unbounded ground with hills: the height of a point above it, times the cosine of the steepest slope.
template <int D>
struct Hills {
    float height = 0.3f;
};
template <int D>
double ground(const Hills<D>& hills, const Vec<D>& point) {
    double result = 0;
    for (int i = 0; i < D; ++i)
        if (i != 1) result += detail::sin_cos(static_cast<double>(point[i])).sin;
    return result * static_cast<double>(hills.height);
}
template <int D>
Aabb<D> bounds(const Hills<D>& hills) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Aabb<D> result{Vec<D>(-infinity), Vec<D>(infinity)};
    result.max[1] = static_cast<float>(D - 1) * hills.height;
    return result;
}
template <int D>
float signed_distance(const Hills<D>& hills, const Vec<D>& point) {
    const double slope = static_cast<double>(hills.height);
    const double steepest = std::sqrt(1 + (D - 1) * slope * slope);
    return static_cast<float>((static_cast<double>(point[1]) - ground(hills, point)) / steepest);
}

}  // namespace abut::users
