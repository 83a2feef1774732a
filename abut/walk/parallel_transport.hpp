#pragma once

// Parallel transport along a geodesic over a walk mesh. Not for users.

#include <abut/math/dvec.hpp>
#include <abut/walk/data.hpp>

namespace abut::detail {

/// The transport that maps one tangent to another: the first in the frame of the geodesic's first triangle, the second
/// in that of its last. `square` is the product of their lengths. `mirrored`: the last triangle is walked on from its
/// other side.
WalkTurn transport_along(const WalkTriangle& from, const DVec<2>& tangent_from, const WalkTriangle& to,
                         const DVec<2>& tangent_to, bool mirrored, double square);

}  // namespace abut::detail
