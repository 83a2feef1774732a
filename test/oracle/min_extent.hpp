#pragma once

// Whether two polytopes have a separating axis: decided in double if rounding can't matter, else in rational numbers.

#include "polytope.hpp"

#include <limits>

namespace abut::oracle {

enum class Arithmetic {
    exact,           ///< rational numbers decide where doubles can't
    floating_point,  ///< in double alone
};

/// The least extent of the Minkowski difference over all axes; below zero if an axis separates.
template <int D>
struct MinExtent {
    bool overlap = true;
    bool rational = false;
    double extent = std::numeric_limits<double>::infinity();  ///< along `normal`, in double
    DVec<D> normal{0.0};                                      ///< of length 1, from A to B
};

/// The cores, without their radii.
template <int D>
MinExtent<D> min_extent(const Polytope<D>& a, const Polytope<D>& b, Arithmetic arithmetic);

}  // namespace abut::oracle
