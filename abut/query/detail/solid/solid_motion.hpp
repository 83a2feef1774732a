#pragma once

// Motions and rays that start inside of a solid. For .cpp files.

#include <abut/query/closest.hpp>
#include <abut/query/detail/raycast/part_hit.hpp>

namespace abut::detail {

/// How a motion of two shapes, one a solid, begins.
struct SolidStart {
    bool is_inside = false;  ///< deeper than the tolerance
    bool goes_in = false;    ///< and the motion goes further in
    double time = 0;         ///< else the shapes are parted by then; 1 or more if they are not during the motion
    Closest<3> nearest;      ///< at the start
};

/// The start of a motion over time 0 to 1. `closest_at` is the answer of `closest` at a time; `closing` is the speed at
/// which A approaches B along the normal at the start; `max_speed` bounds the speed of all points.
///
/// A depth is a lower bound of the way to a place where the shapes are parted. So the motion goes on by that length,
/// and repeats from there, at most 64 times. After that it counts as parted.
SolidStart start_in_solid(const View<3>& a, const View<3>& b, double max_speed,
                          FunctionRef<Closest<3>(double time)> closest_at,
                          FunctionRef<double(const Closest<3>& nearest)> closing);

/// The first point at which a ray enters a solid. `surface_hit` finds the first hit of its triangles, from either
/// side.
bool enter_solid(const DRay<3>& beam, const Composite<3>& solid,
                 FunctionRef<bool(const DRay<3>& beam, PartHit<3>& first)> surface_hit, PartHit<3>& first);

}  // namespace abut::detail
