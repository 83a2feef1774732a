#pragma once

// Polytopes as plain lists of corners, edges and triangles, with a ball around them: what the oracle understands.
// Nothing here knows of GJK, support functions or penetration searches.

#include <abut/math/affine.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut::oracle {

/// The hull of place(points), and all within `radius` of it. Edges and triangles may list more than the hull has, as
/// long as they lie in it; they must list at least those that it has.
template <int D>
struct Polytope {
    Affine<D> place;
    std::vector<Vec<D>> points;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 2>> edge_directions;  ///< of `edges`, parallel ones once
    double radius = 0;
};

/// The corners in the number type T, seen from `origin`; exact where T is.
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

/// The corners in double, seen from `origin`.
template <int D>
std::vector<DVec<D>> corners_seen_from(const Polytope<D>& polytope, const DVec<D>& origin) {
    std::vector<DVec<D>> result;
    Affine<D> place = polytope.place;
    place.offset -= origin;
    for (const Vec<D>& point : polytope.points) result.push_back(place.point(DVec<D>(point)));
    return result;
}

/// Somewhere in the polytope: where to look from.
template <int D>
DVec<D> middle(const Polytope<D>& polytope) {
    DVec<D> low(std::numeric_limits<double>::infinity()), high(-low);
    for (const DVec<D>& p : corners_seen_from(polytope, DVec<D>(0.0)))
        for (int i = 0; i < D; ++i) {
            low[i] = std::min(low[i], p[i]);
            high[i] = std::max(high[i], p[i]);
        }
    return (low + high) * 0.5;
}

/// The bounding radius about the middle.
template <int D>
double size(const Polytope<D>& polytope) {
    double most = 0;
    for (const DVec<D>& p : corners_seen_from(polytope, middle(polytope))) most = std::max(most, length(p));
    return most + polytope.radius;
}

/// The largest coordinate of either shape, seen from the middle of A.
template <int D>
double largest_coordinate(const Polytope<D>& a, const Polytope<D>& b) {
    const DVec<D> origin = middle(a);
    double most = 0;
    for (const Polytope<D>* polytope : {&a, &b})
        for (const DVec<D>& p : corners_seen_from(*polytope, origin))
            most = std::max(most, largest(p) + polytope->radius);
    return most;
}

/// One step of a float as large as x.
inline double ulp(double x) {
    const float f = static_cast<float>(std::abs(x));
    return static_cast<double>(std::nextafter(f, std::numeric_limits<float>::infinity())) - static_cast<double>(f);
}

/// How far rounding the coordinates of a point to floats moves it at most.
template <int D>
double rounding_of(const Vec<D>& point) {
    double result = 0;
    for (int i = 0; i < D; ++i) result += ulp(static_cast<double>(point[i]));
    return result;
}

/// How far placing a shape in double may move it, which matters where two points far from the origin are the same.
template <int D>
double placing_error(const Polytope<D>& polytope) {
    return 1e-14 * std::max(largest(middle(polytope)), largest(polytope.place.offset));
}

/// How far an answer about a and b may be off, and how near to touching a yes or no may go either way.
template <int D>
double tolerance_for(const Polytope<D>& a, const Polytope<D>& b) {
    return 1e-5 * std::min(size(a), size(b)) + 16 * ulp(largest_coordinate(a, b)) +
           std::max(placing_error(a), placing_error(b));
}

template <int D>
void add_edge(Polytope<D>& polytope, std::uint32_t i, std::uint32_t j) {
    polytope.edges.push_back({i, j});
    polytope.edge_directions.push_back({i, j});
}

/// The hull of a few points, by trying all pairs and triples of them; where there is doubt, what is tried counts.
template <int D>
Polytope<D> hull_of(std::vector<Vec<D>> points, double radius = 0);

/// The box between two corners, seen by `place`.
template <int D>
Polytope<D> box_between(const Vec<D>& low, const Vec<D>& high, const Affine<D>& place = {}, double radius = 0);

/// A box about the origin of `place`.
template <int D>
Polytope<D> box_of(const Affine<D>& place, const Vec<D>& half, double radius = 0) {
    return box_between(-half, half, place, radius);
}

/// The same polytope moved, turned or stretched by `map`; its radius must be zero unless `map` is a pose.
template <int D>
Polytope<D> mapped(Polytope<D> polytope, const Affine<D>& map) {
    polytope.place = map * polytope.place;
    return polytope;
}

}  // namespace abut::oracle
