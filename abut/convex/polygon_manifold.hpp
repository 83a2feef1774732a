#pragma once

// The points in which two polygons of few sides meet, where the side of one and the corner of the other are known.

#include <abut/convex/manifold.hpp>
#include <abut/convex/polygon_pair.hpp>

namespace abut {

/// What `manifold` gives, of polygons rounded by their radii that meet as `meeting` says; written where it is wanted,
/// as what is copied at once has to be waited for.
void set_polygon_manifold(const PolygonPair& pair, const Meeting& meeting, const SignedDistance<2>& distance,
                          double margin, Manifold<2>& result);

}  // namespace abut
