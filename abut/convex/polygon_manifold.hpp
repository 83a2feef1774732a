#pragma once

// The points in which two polygons of few sides meet, where the side of one and the corner of the other are known.

#include <abut/convex/manifold.hpp>
#include <abut/convex/polygon_pair.hpp>

namespace abut {

/// What `manifold` gives, of polygons rounded by their radii that meet as `meeting` says.
Manifold<2> polygon_manifold(const PolygonPair& pair, const Meeting& meeting, const SignedDistance<2>& distance,
                             double margin);

}  // namespace abut
