#pragma once

// Compares the library's answers for a pair with the oracle's.

#include "distance.hpp"
#include "sample.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/overlaps.hpp>

#include <gtest/gtest.h>

namespace abut::oracle {

using detail::DVec;
using detail::length;

/// The counts and largest errors over many pairs.
struct Tally {
    int pairs = 0;
    int overlapping = 0;
    int rational = 0;                    ///< pairs decided in rational numbers
    double max_error_ratio = 0;          ///< the largest error of a distance, as a share of its tolerance
    double max_surface_error_ratio = 0;  ///< the largest distance of a closest point from its surface, as a share

    double overlapping_share() const { return static_cast<double>(overlapping) / static_cast<double>(pairs); }
};

/// The distance of a point from the surface of a shape.
template <int D>
double distance_to_surface(const Polytope<D>& shape, const Vec<D>& point) {
    return std::abs(truth(shape, hull_of<D>({point}), Arithmetic::floating_point).distance);
}

template <int D>
double gap_along_with_radii(const Polytope<D>& a, const Polytope<D>& b, const DVec<D>& n) {
    return gap_along(a, b, n) - a.radius - b.radius;
}

template <int D>
void check_pair(const Sample<D>& a, const Sample<D>& b, Tally& tally) {
    const Truth<D> truth = oracle::truth(a.solid, b.solid);
    const double tolerance = tolerance_for(a.solid, b.solid);
    ASSERT_LE(truth.duality_gap, 0.2 * tolerance) << "the oracle itself is wrong";
    ++tally.pairs;
    tally.overlapping += truth.overlap ? 1 : 0;
    tally.rational += truth.rational ? 1 : 0;

    if (std::abs(truth.distance) > tolerance) {
        EXPECT_EQ(overlaps(a.view, b.view), truth.overlap);
    }

    const Closest<D> found = closest(a.view, b.view);
    const double distance = static_cast<double>(found.distance);
    const double error = std::abs(distance - truth.distance) / tolerance;
    EXPECT_LE(error, 1) << "distance " << distance << " instead of " << truth.distance;
    tally.max_error_ratio = std::max(tally.max_error_ratio, error);

    // The gap along the normal is the reported distance.
    const DVec<D> normal(found.normal);
    EXPECT_NEAR(length(normal), 1, 1e-6);
    EXPECT_NEAR(gap_along_with_radii(a.solid, b.solid, normal), distance,
                tolerance + 1e-7 * (size(a.solid) + size(b.solid)));

    // The closest points lie on the surfaces, and the normal joins them.
    const double rounding = 2 * rounding_of(found.on_a) + 2 * rounding_of(found.on_b);
    const double off_a = distance_to_surface(a.solid, found.on_a), off_b = distance_to_surface(b.solid, found.on_b);
    EXPECT_LE(off_a, tolerance + rounding);
    EXPECT_LE(off_b, tolerance + rounding);
    tally.max_surface_error_ratio =
        std::max(tally.max_surface_error_ratio, std::max(off_a, off_b) / (tolerance + rounding));
    const DVec<D> residual = DVec<D>(found.on_b) - DVec<D>(found.on_a) - normal * distance;
    EXPECT_LE(length(residual), rounding + 2e-7 * std::abs(distance));
}

}  // namespace abut::oracle
