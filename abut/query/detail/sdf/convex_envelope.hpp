#pragma once

// The minimum of the convex envelope of a function's corner values over the intersection of a box and a convex set. For
// .cpp files.
//
// A point of both is sum(w_j p_j) = sum(w_j c_j), with points p_j of the set, corners c_j and weights w_j >= 0 of sum
// 1; the envelope there is at most sum(w_j f_j). So the minimum is that of a linear program over pairs (p_j, c_j),
//
//    minimise sum(w_j f_j)  where  sum(w_j (p_j - c_j)) = 0, sum(w_j) = 1, w >= 0,
//
// which the revised simplex method solves with D + 1 pairs at a time (Dantzig, Wolfe, "Decomposition principle for
// linear programs", 1960). It is GJK's ray cast (van den Bergen, 2004), one dimension higher. Its dual is a vector u,
// and
//
//    bound(u) = min over the set of dot(u, p) + min over corners of (f - dot(u, c))
//
// is a lower bound for every u, so the search may stop at any time.

#include <abut/query/detail/sdf/conditional_gradient.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace abut::detail {

template <int D>
struct EnvelopeBound {
    double bound = -std::numeric_limits<double>::infinity();  ///< at most the minimum
    PathPoint<D> place{0.0};                                  ///< a point of the set, near the minimum of the envelope
};

/// `axes` are the half axes of a box around `center`, and `values` those at its corners: bit a of a corner's index
/// chooses the upper side along axis a. lowest(u) returns the point of the set that minimises dot(u, p). The search
/// stops at a bound above `sufficient`, or when the bound no longer grows. `start` is the first u. `steepest` is about
/// the largest useful change of u, and grows as needed; `size` is about the size of the set.
template <int D, class Lowest>
EnvelopeBound<D> envelope_bound(const std::array<DVec<D>, static_cast<std::size_t>(D)>& axes, const DVec<D>& center,
                                const std::array<double, std::size_t{1} << D>& values, const DVec<D>& start,
                                double sufficient, double steepest, double size, const Lowest& lowest) {
    constexpr std::size_t rows = static_cast<std::size_t>(D) + 1;
    constexpr int max_pivots = 24;
    using Row = std::array<double, rows>;
    // The first pairs are artificial variables at the corners of a simplex, so high that none of them stays in a
    // solution.
    std::array<Row, rows> inverse{};
    std::array<PathPoint<D>, rows> points{};
    std::array<bool, rows> is_artificial;
    is_artificial.fill(true);
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t a = 0; a + 1 < rows; ++a) inverse[j][a] = -1 / (static_cast<double>(rows) * size);
        if (j + 1 < rows) inverse[j][j] += 1 / size;
        inverse[j][rows - 1] = 1 / static_cast<double>(rows);
    }
    EnvelopeBound<D> result;
    DVec<D> u = start;
    double value = std::numeric_limits<double>::infinity();
    for (int pivot = 0;; ++pivot) {
        const PathPoint<D> lowest_point = lowest(u);
        const DVec<D> point = DVec<D>(lowest_point) - center;
        std::array<double, static_cast<std::size_t>(D)> rise;
        for (std::size_t a = 0; a < axes.size(); ++a) rise[a] = dot(u, axes[a]);
        std::size_t lowest_corner = 0;
        double above = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < values.size(); ++i) {
            double along = 0;
            for (std::size_t a = 0; a < rise.size(); ++a) along += (i >> a & 1) != 0 ? rise[a] : -rise[a];
            const double height = values[i] - along;
            lowest_corner = height < above ? i : lowest_corner;
            above = std::min(above, height);
        }
        const double bound = above + dot(u, point);
        if (pivot == 0) {
            result.place = lowest_point;
            value = std::max(sufficient, bound) + steepest * size;
        }
        result.bound = std::max(result.bound, bound);
        if (result.bound > sufficient || pivot == max_pivots) break;
        if (value <= sufficient) {
            // Raise the remaining artificial variables: larger changes of u may still help.
            double artificial_weight = 0;
            for (std::size_t j = 0; j < rows; ++j)
                if (is_artificial[j]) artificial_weight += inverse[j][rows - 1];
            if (!(artificial_weight > 1e-9)) break;
            const double raised = std::max(steepest * size, (sufficient - value) / artificial_weight);
            steepest *= 2;
            for (std::size_t j = 0; j < rows; ++j) {
                if (!is_artificial[j]) continue;
                for (int a = 0; a < D; ++a) u[a] -= raised * inverse[j][static_cast<std::size_t>(a)];
                value += raised * inverse[j][rows - 1];
            }
            continue;
        }
        if (!(value - bound > 1e-3 * (value - sufficient))) break;
        // The pair enters in place of the first one whose weight would fall below zero.
        DVec<D> across = point;
        for (std::size_t a = 0; a < axes.size(); ++a) across -= (lowest_corner >> a & 1) != 0 ? axes[a] : -axes[a];
        Row share;
        std::size_t leaving = rows;
        double min_ratio = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < rows; ++j) {
            share[j] = inverse[j][rows - 1];
            for (int a = 0; a < D; ++a) share[j] += inverse[j][static_cast<std::size_t>(a)] * across[a];
            if (!(share[j] > 1e-12)) continue;
            const double ratio = std::max(inverse[j][rows - 1], 0.0) / share[j];
            if (ratio < min_ratio || (ratio == min_ratio && is_artificial[j])) {
                min_ratio = ratio;
                leaving = j;
            }
        }
        if (leaving == rows) break;
        is_artificial[leaving] = false;
        points[leaving] = lowest_point;
        for (double& entry : inverse[leaving]) entry /= share[leaving];
        for (std::size_t j = 0; j < rows; ++j)
            if (j != leaving)
                for (std::size_t a = 0; a < rows; ++a) inverse[j][a] -= share[j] * inverse[leaving][a];
        const double change = bound - value;
        for (int a = 0; a < D; ++a) u[a] -= change * inverse[leaving][static_cast<std::size_t>(a)];
        value += change * inverse[leaving][rows - 1];
    }
    PathPoint<D> sum(0.0);
    double weights = 0;
    for (std::size_t j = 0; j < rows; ++j) {
        if (is_artificial[j]) continue;
        const double weight = std::max(inverse[j][rows - 1], 0.0);
        sum += points[j] * weight;
        weights += weight;
    }
    if (weights > 1e-6) result.place = sum / weights;
    return result;
}

}  // namespace abut::detail
