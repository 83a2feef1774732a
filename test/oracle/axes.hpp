#pragma once

// The candidates for a separating axis of two polytopes, in doubles and in rational numbers.
//
// The Minkowski difference A - B is a polytope whose edges have the directions of the edges of A and B. If the origin
// is outside of it, the normal of one of its faces is a separating axis. Two such directions span each face. If the
// difference is flat, the axis may also lie in its plane.

#include "polytope.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace abut::oracle {

using detail::cross;
using detail::dot;
using detail::DVec;
using detail::length;
using detail::normalized;
using detail::unit;

using abut::detail::cross;
using abut::detail::dot;

template <class T>
T dot(const std::array<T, 2>& a, const std::array<T, 2>& b) {
    return T(a[0] * b[0] + a[1] * b[1]);
}
template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
    return T(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
template <class T>
std::array<T, 3> cross(const std::array<T, 3>& a, const std::array<T, 3>& b) {
    return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}
template <class T, std::size_t D>
std::array<T, D> minus(const std::array<T, D>& a, const std::array<T, D>& b) {
    std::array<T, D> result;
    for (std::size_t i = 0; i < D; ++i) result[i] = a[i] - b[i];
    return result;
}
/// The component of v perpendicular to e, times dot(e, e).
template <class T, std::size_t D>
std::array<T, D> perpendicular_part(const std::array<T, D>& e, const std::array<T, D>& v) {
    const T length_squared = dot(e, e), along = dot(e, v);
    std::array<T, D> result;
    for (std::size_t i = 0; i < D; ++i) result[i] = length_squared * v[i] - along * e[i];
    return result;
}

/// The corners of two polytopes relative to one origin, in numbers of the type T.
template <class T, int D>
struct LocalPair {
    using Vector = std::array<T, static_cast<std::size_t>(D)>;
    std::vector<Vector> a, b, directions;

    LocalPair(const Polytope<D>& polytope_a, const Polytope<D>& polytope_b, const DVec<D>& origin)
        : a(corners<T>(polytope_a, origin)), b(corners<T>(polytope_b, origin)) {
        for (const auto& [i, j] : polytope_a.edge_directions) directions.push_back(minus(a[j], a[i]));
        for (const auto& [i, j] : polytope_b.edge_directions) directions.push_back(minus(b[j], b[i]));
    }

    Vector offset() const { return minus(b[0], a[0]); }
};

template <class T, std::size_t D>
std::array<T, D> coordinate_axis(std::size_t i) {
    std::array<T, D> result{};
    result[i] = 1;
    return result;
}

/// Visits all candidates, in one order for every T. The last ones matter only if the difference is flat or a point.
template <class T, class Visit>
void each_candidate_axis(const LocalPair<T, 2>& s, bool, Visit&& visit) {
    for (const auto& e : s.directions) visit(std::array<T, 2>{T(-e[1]), e[0]});
    for (const auto& e : s.directions) visit(e);
    visit(s.offset());
    for (std::size_t i = 0; i < 2; ++i) visit(coordinate_axis<T, 2>(i));
}
template <class T, class Visit>
void each_candidate_axis(const LocalPair<T, 3>& s, bool flat, Visit&& visit) {
    for (std::size_t i = 0; i < s.directions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) visit(cross(s.directions[i], s.directions[j]));
    if (!flat) return;
    for (std::size_t i = 0; i < s.directions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (const auto& e : s.directions) visit(cross(cross(s.directions[i], s.directions[j]), e));
    for (const auto& e : s.directions) visit(e);
    visit(s.offset());
    for (const auto& e : s.directions) visit(perpendicular_part(e, s.offset()));
    for (std::size_t i = 0; i < 3; ++i) {
        visit(coordinate_axis<T, 3>(i));
        for (const auto& e : s.directions) visit(perpendicular_part(e, coordinate_axis<T, 3>(i)));
    }
}

/// The overlap of the projections of A and B: that of A's end with B's beginning, along n and along -n.
template <class T, int D>
std::array<T, 2> extents(const LocalPair<T, D>& s, const typename LocalPair<T, D>::Vector& n) {
    T low_a = dot(n, s.a[0]), high_a = low_a, low_b = dot(n, s.b[0]), high_b = low_b;
    for (const auto& p : s.a) {
        const T along = dot(n, p);
        if (along < low_a) low_a = along;
        if (along > high_a) high_a = along;
    }
    for (const auto& p : s.b) {
        const T along = dot(n, p);
        if (along < low_b) low_b = along;
        if (along > high_b) high_b = along;
    }
    return {T(high_a - low_b), T(high_b - low_a)};
}

inline bool is_nearly_flat(const LocalPair<double, 2>&) {
    return false;
}
inline bool is_nearly_flat(const LocalPair<double, 3>& s) {
    const auto unit = [](const std::array<double, 3>& v) {
        return normalized(DVec<3>(v[0], v[1], v[2]), DVec<3>(0.0));
    };
    DVec<3> widest(0.0);
    for (const auto& e : s.directions)
        for (const auto& f : s.directions) {
            const DVec<3> normal = cross(unit(e), unit(f));
            if (length(normal) > length(widest)) widest = normal;
        }
    if (length(widest) < 1e-3) return true;
    for (const auto& e : s.directions)
        if (std::abs(dot(unit(e), normalized(widest))) > 1e-6) return false;
    return true;
}

}  // namespace abut::oracle
