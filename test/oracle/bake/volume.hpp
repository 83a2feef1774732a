#pragma once

// The volume of the overlap of two polytopes, in rational numbers.

#include "../axes.hpp"
#include "../rational.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace abut::oracle {

using detail::cross;
using detail::dot;

/// Half-spaces a . x <= b in rational numbers. The volume of their intersection needs none of its corners (Lasserre,
/// "An analytical expression and an algorithm for the volume of a convex polyhedron in R^n", 1983).
struct HalfSpaces {
    std::vector<std::vector<Rational>> a;
    std::vector<Rational> b;

    /// Adds a half-space; of parallel ones only the tightest is stored. False if the half-space is empty.
    bool add(std::vector<Rational> row, Rational right) {
        const auto lead = std::find_if(row.begin(), row.end(), [](const Rational& x) { return x != 0; });
        if (lead == row.end()) return right >= 0;
        const Rational scale = abs(*lead);
        for (Rational& x : row) x /= scale;
        right /= scale;
        for (std::size_t i = 0; i < a.size(); ++i) {
            if (a[i] != row) continue;
            if (right < b[i]) b[i] = right;
            return true;
        }
        a.push_back(std::move(row));
        b.push_back(std::move(right));
        return true;
    }
};

inline Rational volume(const HalfSpaces& spaces, std::size_t dimensions) {
    if (dimensions == 1) {
        std::optional<Rational> low, high;
        for (std::size_t i = 0; i < spaces.a.size(); ++i) {
            const Rational end = spaces.b[i] / spaces.a[i][0];
            if (spaces.a[i][0] > 0)
                high = high ? std::min(*high, end) : end;
            else
                low = low ? std::max(*low, end) : end;
        }
        return low && high && *low < *high ? Rational(*high - *low) : Rational(0);
    }
    Rational sum = 0;
    for (std::size_t i = 0; i < spaces.a.size(); ++i) {
        std::size_t j = 0;
        while (spaces.a[i][j] == 0) ++j;
        const Rational pivot = spaces.a[i][j];
        HalfSpaces face;  // row i solved for x_j and substituted
        bool empty = false;
        for (std::size_t k = 0; k < spaces.a.size() && !empty; ++k) {
            if (k == i) continue;
            const Rational factor = spaces.a[k][j] / pivot;
            std::vector<Rational> row;
            for (std::size_t m = 0; m < dimensions; ++m)
                if (m != j) row.push_back(spaces.a[k][m] - factor * spaces.a[i][m]);
            empty = !face.add(std::move(row), spaces.b[k] - factor * spaces.b[i]);
        }
        if (!empty) sum += spaces.b[i] / abs(pivot) * volume(face, dimensions - 1);
    }
    return sum / static_cast<int>(dimensions);
}

/// The supporting planes through D corners. A flat shape has no more than two.
template <int D>
HalfSpaces half_spaces(const Polytope<D>& shape, const DVec<D>& origin) {
    HalfSpaces spaces;
    const auto points = corners<Rational>(shape, origin);
    const auto offer = [&](const std::array<Rational, static_cast<std::size_t>(D)>& normal, std::size_t through) {
        const Rational offset = dot(normal, points[through]);
        bool below = false, above = false;
        for (const auto& point : points) {
            const Rational along = dot(normal, point);
            below = below || along < offset;
            above = above || along > offset;
        }
        std::vector<Rational> row(normal.begin(), normal.end());
        if (!above) spaces.add(row, offset);
        for (Rational& x : row) x = -x;
        if (!below) spaces.add(row, -offset);
    };
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const auto edge = minus(points[j], points[i]);
            if constexpr (D == 2)
                offer({Rational(-edge[1]), edge[0]}, i);
            else
                for (std::size_t k = 0; k < j; ++k) offer(cross(edge, minus(points[k], points[i])), i);
        }
    return spaces;
}

/// The area or volume of the intersection of two polytopes, without their radii; 0 if one is flat.
template <int D>
double volume_of_overlap(const Polytope<D>& a, const Polytope<D>& b) {
    const DVec<D> origin = middle(a);
    HalfSpaces intersection = half_spaces(a, origin);
    const HalfSpaces others = half_spaces(b, origin);
    if (intersection.a.size() <= 2 || others.a.size() <= 2) return 0;
    for (std::size_t i = 0; i < others.a.size(); ++i) intersection.add(others.a[i], others.b[i]);
    return static_cast<double>(volume(intersection, D));
}

}  // namespace abut::oracle
