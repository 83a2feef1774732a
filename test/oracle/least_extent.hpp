#pragma once

// Whether some axis parts two polytopes: decided in double where rounding can't matter, and in rational numbers where
// it could.

#include "polytope.hpp"

#include <limits>

namespace abut::oracle {

enum class Arithmetic {
    exact,  ///< yes or no is decided in rational numbers where need be
    rough,  ///< in double alone
};

/// The least extent over all axes.
template <int D>
struct LeastExtent {
    bool overlap = true;
    bool rational = false;
    double extent = std::numeric_limits<double>::infinity();  ///< along `normal`, to some digits
    DVec<D> normal{0.0};                                      ///< of length 1, from A to B
};

/// The cores, without their radii.
template <int D>
LeastExtent<D> least_extent(const Polytope<D>& a, const Polytope<D>& b, Arithmetic arithmetic);

}  // namespace abut::oracle
