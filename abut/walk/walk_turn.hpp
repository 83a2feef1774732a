#pragma once

// How a way over a surface turns what is carried along it. Not for users.

#include <abut/math/dvec.hpp>
#include <abut/walk/walk_data.hpp>

namespace abut {

/// A tangent, given in the frame of the triangle where a way begins, and the same carried along it, in the frame of
/// that where it ends; `square` is the product of their lengths. `mirrored`: the last triangle is walked on from its
/// other side.
WalkTurn turn_along(const WalkTriangle& from, const DVec<2>& tangent_from, const WalkTriangle& to,
                    const DVec<2>& tangent_to, bool mirrored, double square);

}  // namespace abut
