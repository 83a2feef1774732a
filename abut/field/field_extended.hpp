#pragma once

// The distance of a field as the questions see it: interpolated within the volume, and continued outside of it. For
// .cpp files.
//
// Outside, n is the point of the volume nearest to p, and d(n) the interpolated distance there. All of the surface lies
// behind the plane through n at right angles to the way from n to p, so that
//
//     distance(p) >= sqrt(|p - n|^2 + max(d(n), 0)^2)
//
// to what interpolation is right to; nor is it less than the distance to the box around the surface. The larger of both
// is the distance, which has no step at the border of the volume, unless the volume cuts the solid.

#include <abut/field/data.hpp>
#include <abut/shape/view/distance_function.hpp>

namespace abut::detail {

/// The distance at any point of the field's own frame, and how it grows there along each axis.
template <int D>
double extended_distance(const FieldData<D>& data, const DVec<D>& point, DVec<D>& gradient);

/// What it is at least in a box of the field's own frame.
template <int D>
DistanceBoundStatus extended_bound(const FieldData<D>& data, const DVec<D>& low, const DVec<D>& high,
                                   DistanceBound<D>& bound);

/// From point to point it changes by no more than this times what they are apart. Along each axis it grows as samples
/// do, to which half a step may be added.
template <int D>
float extended_slope(const FieldData<D>& data);

/// Whether all of the surface is in the volume: if it isn't, the solid ends with the volume, and the distance is
/// not continuous there.
template <int D>
bool holds_surface(const FieldData<D>& data);

}  // namespace abut::detail
