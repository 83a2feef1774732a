#pragma once

// An oriented line or plane, in double.

#include <abut/math/vec.hpp>

namespace abut::detail {

/// A line in 2D, a plane in 3D: dot(normal, p) == offset, with larger values above it.
template <int D>
struct Plane {
    DVec<D> normal;
    double offset = 0;
};

}  // namespace abut::detail
