#pragma once

// Polytopes as plain lists of corners, edges and triangles, with a ball around them: what the oracle understands.
// Nothing here knows of GJK, support functions or penetration searches.

#include <abut/math/linear.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
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
double margin_of_doubt(const Polytope<D>& a, const Polytope<D>& b) {
    return 1e-5 * std::min(size(a), size(b)) + 16 * ulp(largest_coordinate(a, b)) +
           std::max(placing_error(a), placing_error(b));
}

template <int D>
void add_edge(Polytope<D>& polytope, std::uint32_t i, std::uint32_t j) {
    polytope.edges.push_back({i, j});
    polytope.edge_directions.push_back({i, j});
}

/// Whether points lie on either side of a line, beyond any rounding of the doubles that say so.
inline bool parts_points(const std::vector<Vec<2>>& points, std::uint32_t i, std::uint32_t j) {
    const DVec<2> from(points[i]), along = DVec<2>(points[j]) - from;
    bool left = false, right = false;
    for (const Vec<2>& point : points) {
        const DVec<2> to = DVec<2>(point) - from;
        const double one = along.x * to.y, other = along.y * to.x;
        const double doubt = 4e-16 * (std::abs(one) + std::abs(other));
        left = left || one - other > doubt;
        right = right || one - other < -doubt;
        if (left && right) return true;
    }
    return false;
}

/// Where a plane runs.
enum class Plane {
    along,    ///< along a face, or so near that rounding can't tell
    through,  ///< through the hull
    unknown,  ///< nowhere: its three points lie on a line
};

/// The plane of three of the points. The bounds are those of Shewchuk's "Adaptive precision floating-point arithmetic"
/// (1997).
inline Plane plane_of(const std::vector<Vec<3>>& points, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const auto absolute = [](const DVec<3>& v) { return DVec<3>(std::abs(v.x), std::abs(v.y), std::abs(v.z)); };
    const DVec<3> from(points[i]), u = DVec<3>(points[j]) - from, v = DVec<3>(points[k]) - from;
    const DVec<3> normal = cross(u, v), s = absolute(u), t = absolute(v);
    const DVec<3> terms(s.y * t.z + s.z * t.y, s.z * t.x + s.x * t.z, s.x * t.y + s.y * t.x);
    bool sure = false;
    for (int axis = 0; axis < 3; ++axis) sure = sure || std::abs(normal[axis]) > 4e-16 * terms[axis];
    if (!sure) return Plane::unknown;
    bool above = false, below = false;
    for (const Vec<3>& point : points) {
        const DVec<3> to = DVec<3>(point) - from;
        const double height = dot(normal, to), doubt = 8e-16 * dot(terms, absolute(to));
        above = above || height > doubt;
        below = below || height < -doubt;
        if (above && below) return Plane::through;
    }
    return Plane::along;
}

/// The hull of a few points, by trying all pairs and triples of them; where there is doubt, what is tried counts.
template <int D>
Polytope<D> hull_of(std::vector<Vec<D>> points, double radius = 0) {
    Polytope<D> result;
    result.points = std::move(points);
    result.radius = radius;
    std::vector<std::uint32_t> different;
    for (std::uint32_t i = 0; i < result.points.size(); ++i) {
        const auto same = [&](std::uint32_t j) { return result.points[i] == result.points[j]; };
        if (std::none_of(different.begin(), different.end(), same)) different.push_back(i);
    }
    const std::size_t count = different.size();
    if constexpr (D == 2) {
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (!parts_points(result.points, different[i], different[j]))
                    add_edge(result, different[i], different[j]);
    } else {
        if (count == 2) add_edge(result, different[1], different[0]);
        std::vector<bool> used(count * count);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < i; ++j)
                for (std::size_t k = 0; k < j; ++k) {
                    const Plane plane = plane_of(result.points, different[i], different[j], different[k]);
                    if (plane == Plane::through) continue;
                    if (plane == Plane::along) result.triangles.push_back({different[i], different[j], different[k]});
                    for (const auto& [from, to] : {std::array{i, j}, std::array{i, k}, std::array{j, k}}) {
                        if (!used[from * count + to]) add_edge(result, different[from], different[to]);
                        used[from * count + to] = true;
                    }
                }
    }
    return result;
}

/// The box between two corners, seen by `place`.
template <int D>
Polytope<D> box_between(const Vec<D>& low, const Vec<D>& high, const Affine<D>& place = {}, double radius = 0) {
    Polytope<D> result;
    result.place = place;
    result.radius = radius;
    constexpr std::uint32_t count = 1u << D;
    for (std::uint32_t i = 0; i < count; ++i) {
        Vec<D>& corner = result.points.emplace_back(low);
        for (int axis = 0; axis < D; ++axis)
            if ((i >> axis & 1u) != 0) corner[axis] = high[axis];
        for (std::uint32_t bit = 1; bit < count; bit *= 2)
            if ((i & bit) == 0) result.edges.push_back({i, i | bit});
    }
    for (std::uint32_t bit = 1; bit < count; bit *= 2) result.edge_directions.push_back({0, bit});
    if constexpr (D == 3)
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t across = 1u << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
            for (std::uint32_t side : {0u, across}) {
                result.triangles.push_back({side, side | u, side | v});
                result.triangles.push_back({side | u | v, side | u, side | v});
            }
        }
    return result;
}

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
