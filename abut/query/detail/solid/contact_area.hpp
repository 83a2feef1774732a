#pragma once

// Where the surfaces of two solids touch that share no inner point. For .cpp files.

#include <abut/convex/manifold/manifold.hpp>
#include <abut/query/detail/solid/placed_solid.hpp>
#include <abut/query/feature.hpp>

namespace abut::detail {

/// The corners of the area in which A touches B after a move of B.
struct SolidContactArea {
    Manifold<3> manifold;  ///< positions are on A; depths are 0
    Feature feature_a, feature_b;
};

/// The points that have the normal, from A to B; all of them if none have it. Surfaces up to `tolerance` apart touch.
SolidContactArea contact_area(const PlacedSolid& a, const PlacedSolid& b, const DVec<3>& move, const DVec<3>& normal,
                              double tolerance);

/// Visits the contact area of each plane on which A touches B after the move, with its normal from A to B: first that
/// of `normal`, then those of faces with other normals, up to a capacity of 32. If no face has a normal, it visits all
/// points as one area. The visitor returns false to stop.
void each_contact_area(const PlacedSolid& a, const PlacedSolid& b, const DVec<3>& move, const DVec<3>& normal,
                       double tolerance, FunctionRef<bool(const DVec<3>& normal, const SolidContactArea& area)> visit);

/// A direction in which B leaves A, which it touches. `step` is so small a move that it counts as none.
DVec<3> touching_normal(const PlacedSolid& a, const PlacedSolid& b, double step);

}  // namespace abut::detail
