#pragma once

// Asks the library about a pair and holds its answers against the oracle's.

#include "distance.hpp"
#include "sample.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/overlaps.hpp>

#include <gtest/gtest.h>

namespace abut::oracle {

/// What was seen over many pairs.
struct Tally {
    int pairs = 0;
    int overlapping = 0;
    int rational = 0;             ///< decided in rational numbers
    double worst_of_margin = 0;   ///< the largest error of a distance, as a part of its margin of doubt
    double worst_of_surface = 0;  ///< the same for how far a point is off the surface that it should lie on

    double overlapping_share() const { return static_cast<double>(overlapping) / static_cast<double>(pairs); }
};

/// How far a point is off the surface of a shape.
template <int D>
double off_surface(const Polytope<D>& shape, const Vec<D>& point) {
    return std::abs(truth(shape, hull_of<D>({point}), Arithmetic::rough).distance);
}

template <int D>
double rounded_gap_along(const Polytope<D>& a, const Polytope<D>& b, const DVec<D>& n) {
    return gap_along(a, b, n) - a.radius - b.radius;
}

template <int D>
void check_pair(const Sample<D>& a, const Sample<D>& b, Tally& tally) {
    const Truth<D> truth = oracle::truth(a.solid, b.solid);
    const double margin = tolerance_for(a.solid, b.solid);
    ASSERT_LE(truth.unproved, 0.2 * margin) << "the oracle itself is wrong";
    ++tally.pairs;
    tally.overlapping += truth.overlap ? 1 : 0;
    tally.rational += truth.rational ? 1 : 0;

    if (std::abs(truth.distance) > margin) {
        EXPECT_EQ(overlaps(a.view, b.view), truth.overlap);
    }

    const Closest<D> found = closest(a.view, b.view);
    const double distance = static_cast<double>(found.distance);
    const double error = std::abs(distance - truth.distance) / margin;
    EXPECT_LE(error, 1) << "distance " << distance << " instead of " << truth.distance;
    tally.worst_of_margin = std::max(tally.worst_of_margin, error);

    // The normal parts them by as much as the answer says.
    const DVec<D> normal(found.normal);
    EXPECT_NEAR(length(normal), 1, 1e-6);
    EXPECT_NEAR(rounded_gap_along(a.solid, b.solid, normal), distance, margin + 1e-7 * (size(a.solid) + size(b.solid)));

    // The points lie on the surfaces, the one across from the other.
    const double rounding = 2 * rounding_of(found.on_a) + 2 * rounding_of(found.on_b);
    const double off_a = off_surface(a.solid, found.on_a), off_b = off_surface(b.solid, found.on_b);
    EXPECT_LE(off_a, margin + rounding);
    EXPECT_LE(off_b, margin + rounding);
    tally.worst_of_surface = std::max(tally.worst_of_surface, std::max(off_a, off_b) / (margin + rounding));
    const DVec<D> across = DVec<D>(found.on_b) - DVec<D>(found.on_a) - normal * distance;
    EXPECT_LE(length(across), rounding + 2e-7 * std::abs(distance));
}

}  // namespace abut::oracle
