#pragma once

// Linear programming in 3D over a few half-spaces.

#include <abut/math/detail/plane.hpp>

#include <optional>
#include <span>

namespace abut::detail {

/// The same plane with its sides swapped.
template <int D>
Plane<D> flipped(const Plane<D>& plane) {
    return {-plane.normal, -plane.offset};
}

/// The point with the minimum dot(cost, p) above (or on) all planes, by the dual simplex method (Lemke 1954). Nothing
/// if there is none, or none within 1e4 times `size` of the origin. The normals have length 1; the point may be below a
/// plane by 1e-11 times `size`. Intended for some ten planes, because each step tests all of them.
std::optional<DVec<3>> lowest_above(std::span<const Plane<3>> planes, const DVec<3>& cost, double size);

}  // namespace abut::detail
