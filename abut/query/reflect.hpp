#pragma once

// A ray thrown back by what it hit: a laser at a mirror, a ball at a wall.

#include <abut/query/raycast.hpp>

namespace abut {

/// What is left of `ray` after `hit`, as a flat mirror at the hit throws it back: it leaves at the angle at which it
/// came, and reaches as far as was left.
///
/// Neither rounding nor a grazing angle takes it through the mirror: it starts some 4 ulp before the surface, on the
/// piece of the way that was free, and its direction leaves the surface by 4e-7 at least. The way is off by no more
/// than 8 ulp for that. NaN or infinity trip ABUT_ASSERT, and give a ray of length 0.
template <int D>
Ray<D> reflect(const Ray<D>& ray, const Hit<D>& hit);

}  // namespace abut
