#pragma once

// Arithmetic on double vectors, for .cpp files. Written out term by term, since the order of operations affects the
// bits of the result.

#include <abut/math/simd/square_root.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {

inline double dot(const DVec<2>& a, const DVec<2>& b) {
    return a.x * b.x + a.y * b.y;
}
inline double dot(const DVec<3>& a, const DVec<3>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline double cross(const DVec<2>& a, const DVec<2>& b) {
    return a.x * b.y - a.y * b.x;
}
inline DVec<3> cross(const DVec<3>& a, const DVec<3>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <int D>
double length_squared(const glm::vec<D, double>& v) {
    return dot(v, v);
}

template <int D>
double length(const glm::vec<D, double>& v) {
    return square_root(dot(v, v));
}

/// The largest absolute coordinate.
template <int D>
double largest(const glm::vec<D, double>& v) {
    double result = 0;
    for (int i = 0; i < D; ++i) result = std::max(result, std::abs(v[i]));
    return result;
}

/// The axis with the largest absolute coordinate, of several the first.
template <int D>
int longest_axis(const glm::vec<D, double>& v) {
    int result = 0;
    for (int i = 1; i < D; ++i)
        if (std::abs(v[i]) > std::abs(v[result])) result = i;
    return result;
}

template <int D>
glm::vec<D, double> axis(int i, double sign = 1) {
    glm::vec<D, double> result(0.0);
    result[i] = sign;
    return result;
}

/// v normalised, safe against overflow and underflow; `otherwise` if v is zero.
template <int D>
glm::vec<D, double> normalized(const glm::vec<D, double>& v, const glm::vec<D, double>& otherwise = axis<D>(0)) {
    const double squared = dot(v, v);
    if (squared > 1e-200 && squared < 1e200) return v / square_root(squared);
    const double scale = largest<D>(v);
    if (!(scale > 0)) return otherwise;
    const glm::vec<D, double> u = v / scale;
    return u / length(u);
}

/// v normalised, for coordinates that were floats, so that squares can't overflow; the first axis if v is zero. A
/// vector that is a unit vector up to float rounding needs no square root: the series omits the third power.
template <int D>
glm::vec<D, double> unit(const glm::vec<D, double>& v) {
    const double square = dot(v, v), excess = square - 1;
    if (std::abs(excess) < 1e-5) return v * (1 - excess * (0.5 - 0.375 * excess));
    return square == 0 ? axis<D>(0) : v * (1 / square_root(square));
}

/// The least and the greatest coordinate on every axis.
template <int D>
struct MinMax {
    DVec<D> min, max;

    DVec<D> middle() const { return 0.5 * (min + max); }
    DVec<D> sides() const { return max - min; }
};
/// Of a range of at least one vector.
template <int D, class Points>
MinMax<D> min_max(const Points& points) {
    MinMax<D> result{DVec<D>(points[0]), DVec<D>(points[0])};
    for (const auto& point : points)
        for (int i = 0; i < D; ++i) {
            result.min[i] = std::min(result.min[i], static_cast<double>(point[i]));
            result.max[i] = std::max(result.max[i], static_cast<double>(point[i]));
        }
    return result;
}

/// A unit vector perpendicular to v.
inline DVec<2> perpendicular(const DVec<2>& v) {
    return normalized<2>(DVec<2>{-v.y, v.x});
}
inline DVec<3> perpendicular(const DVec<3>& v) {
    const DVec<3> a{std::abs(v.x), std::abs(v.y), std::abs(v.z)};
    const int smallest = a.x <= a.y && a.x <= a.z ? 0 : (a.y <= a.z ? 1 : 2);
    return normalized<3>(cross(v, axis<3>(smallest)));
}

template <int D>
Vec<D> to_float(const glm::vec<D, double>& v) {
    return Vec<D>(v);
}

}  // namespace abut::detail
