#pragma once

// The least of a linear function over a few half-spaces.

#include <abut/math/vec.hpp>

#include <optional>
#include <span>

namespace abut {

/// A line in the plane, a plane in space: the points p of dot(normal, p) == offset; above it, it is more.
template <int D>
struct Plane {
    DVec<D> normal;
    double offset = 0;
};

/// The same plane with its sides swapped.
template <int D>
Plane<D> flipped(const Plane<D>& plane) {
    return {-plane.normal, -plane.offset};
}

/// The point with the least dot(cost, p) of all that are above (or on) every plane, by the dual simplex method (Lemke
/// 1954); nothing where there is none, or none within 1e4 times `size` of the origin. The normals have length 1; a
/// point may be below a plane by 1e-11 times `size`. Meant for some ten planes: a step looks at each of them, and takes
/// the place of one of three.
std::optional<DVec<3>> lowest_above(std::span<const Plane<3>> planes, const DVec<3>& cost, double size);

}  // namespace abut
