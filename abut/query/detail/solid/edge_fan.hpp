#pragma once

// The order of half-planes around an edge, by exact predicates. For .cpp files.

#include <abut/query/detail/solid/placed_solid.hpp>

namespace abut::detail {

/// Whether the half-plane through a point, bounded by the axis of the fan, lies inside the solid. Of a fan of fewer
/// than two blades, beside a triangle of zero area, nothing is inside.
PointSide side_of(const EdgeFan& fan, const DVec<3>& point);

/// Whether two solids with the same axis share a sector around it.
bool fans_overlap(const EdgeFan& a, const EdgeFan& b);

/// The same fan, with the direction of its axis reversed.
EdgeFan reversed(const EdgeFan& fan);

}  // namespace abut::detail
