#pragma once

// Reflection of a ray at its hit: a laser at a mirror, a ball at a wall.

#include <abut/query/raycast.hpp>

namespace abut {

/// The rest of `ray` after `hit`, reflected by a flat mirror at the hit: it leaves at the angle at which it came, and
/// its length is the part that was left.
///
/// Neither rounding nor a grazing angle takes it through the mirror. It starts about 4 ulp in front of the surface, on
/// the free part of the path, and its direction leaves the surface by at least 4e-7. This displaces the reflected ray
/// by at most 8 ulp. NaN or infinity trip ABUT_ASSERT; in release the result is a ray of length 0.
template <int D>
Ray<D> reflect(const Ray<D>& ray, const Hit<D>& hit);

}  // namespace abut
