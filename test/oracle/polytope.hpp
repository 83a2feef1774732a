#pragma once

// Polytopes as lists of corners, edges and triangles, with a radius around them: the shapes of the oracle. It uses no
// GJK, EPA or support function, so that it shares no bug with the library.

#include <abut/math/affine.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut::oracle {

using detail::DVec;
using detail::largest;
using detail::length;

/// The convex hull of place(points), and all points within `radius` of it. The lists must hold all edges and triangles
/// of the hull; they may hold others that lie in it.
template <int D>
struct Polytope {
    detail::Affine<D> place;
    std::vector<Vec<D>> points;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 2>> edge_directions;  ///< of `edges`; parallel ones once
    double radius = 0;
};

/// The corners in the number type T, relative to `origin`; exact if T is.
template <class T, int D>
std::vector<std::array<T, D>> corners(const Polytope<D>& polytope, const DVec<D>& origin) {
    std::vector<std::array<T, D>> result;
    for (const Vec<D>& point : polytope.points) {
        std::array<T, D>& corner = result.emplace_back();
        for (int i = 0; i < D; ++i) {
            T sum = T(polytope.place.offset[i]) - T(origin[i]);
            for (int j = 0; j < D; ++j)
                sum += T(polytope.place.column[static_cast<std::size_t>(j)][i]) * T(static_cast<double>(point[j]));
            corner[static_cast<std::size_t>(i)] = sum;
        }
    }
    return result;
}

/// The corners in double, relative to `origin`.
template <int D>
std::vector<DVec<D>> corners_relative_to(const Polytope<D>& polytope, const DVec<D>& origin) {
    std::vector<DVec<D>> result;
    detail::Affine<D> place = polytope.place;
    place.offset -= origin;
    for (const Vec<D>& point : polytope.points) result.push_back(place.point(DVec<D>(point)));
    return result;
}

/// The center of the bounding box: the origin for other computations.
template <int D>
DVec<D> middle(const Polytope<D>& polytope) {
    DVec<D> low(std::numeric_limits<double>::infinity()), high(-low);
    for (const DVec<D>& p : corners_relative_to(polytope, DVec<D>(0.0)))
        for (int i = 0; i < D; ++i) {
            low[i] = std::min(low[i], p[i]);
            high[i] = std::max(high[i], p[i]);
        }
    return (low + high) * 0.5;
}

/// The bounding radius about middle(polytope).
template <int D>
double size(const Polytope<D>& polytope) {
    double result = 0;
    for (const DVec<D>& p : corners_relative_to(polytope, middle(polytope))) result = std::max(result, length(p));
    return result + polytope.radius;
}

/// The largest coordinate of either shape, relative to middle(a).
template <int D>
double largest_coordinate(const Polytope<D>& a, const Polytope<D>& b) {
    const DVec<D> origin = middle(a);
    double result = 0;
    for (const Polytope<D>* polytope : {&a, &b})
        for (const DVec<D>& p : corners_relative_to(*polytope, origin))
            result = std::max(result, largest(p) + polytope->radius);
    return result;
}

/// The spacing of floats at x.
inline double ulp(double x) {
    const float f = static_cast<float>(std::abs(x));
    return static_cast<double>(std::nextafter(f, std::numeric_limits<float>::infinity())) - static_cast<double>(f);
}

/// A bound of the distance by which rounding its coordinates to floats moves a point.
template <int D>
double rounding_of(const Vec<D>& point) {
    double result = 0;
    for (int i = 0; i < D; ++i) result += ulp(static_cast<double>(point[i]));
    return result;
}

/// A bound of the rounding of a shape's transform in double. It matters where two points far from the origin coincide.
template <int D>
double transform_error(const Polytope<D>& polytope) {
    return 1e-14 * std::max(largest(middle(polytope)), largest(polytope.place.offset));
}

/// The tolerance of an answer about a and b. A yes or no may go either way if the distance is within it.
template <int D>
double tolerance_for(const Polytope<D>& a, const Polytope<D>& b) {
    return 1e-5 * std::min(size(a), size(b)) + 16 * ulp(largest_coordinate(a, b)) +
           std::max(transform_error(a), transform_error(b));
}

template <int D>
void add_edge(Polytope<D>& polytope, std::uint32_t i, std::uint32_t j) {
    polytope.edges.push_back({i, j});
    polytope.edge_directions.push_back({i, j});
}

/// The hull of a few points, by brute force over all pairs and triples. An undecided edge or face is included.
template <int D>
Polytope<D> hull_of(std::vector<Vec<D>> points, double radius = 0);

/// The box between two corners, transformed by `place`.
template <int D>
Polytope<D> box_between(const Vec<D>& low, const Vec<D>& high, const detail::Affine<D>& place = {}, double radius = 0);

/// A box about the origin of `place`.
template <int D>
Polytope<D> box_of(const detail::Affine<D>& place, const Vec<D>& half, double radius = 0) {
    return box_between(-half, half, place, radius);
}

/// The polytope transformed by `map`. Its radius must be zero unless `map` is a pose.
template <int D>
Polytope<D> mapped(Polytope<D> polytope, const detail::Affine<D>& map) {
    polytope.place = map * polytope.place;
    return polytope;
}

}  // namespace abut::oracle
