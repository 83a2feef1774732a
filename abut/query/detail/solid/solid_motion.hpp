#pragma once

// Motions and rays that start inside of a solid. For .cpp files.

#include <abut/query/closest.hpp>
#include <abut/query/detail/raycast/part_hit.hpp>
#include <abut/query/hit.hpp>

#include <optional>

namespace abut::detail {

/// The hit of a motion of two shapes, one a solid, over time 0 to 1. `max_speed` bounds the speed of all points, and
/// `length` is that of the whole relative motion. `closest_at` is the answer of `closest` at a time; `closing` is the
/// speed at which A approaches B along the normal at the start. `surface_hit` is the hit of the surfaces during the
/// motion from a time on.
///
/// Shapes that overlap at the start hit at once if they go further in. Otherwise only a hit after they are parted
/// counts. A depth is a lower bound of the path to where they are parted, so the motion goes on by that length, and
/// again from there, at most 64 times. After that it counts as parted.
std::optional<Hit<3>> sweep_solid(const View<3>& a, const View<3>& b, double max_speed, double length,
                                  FunctionRef<Closest<3>(double time)> closest_at,
                                  FunctionRef<double(const Closest<3>& nearest)> closing,
                                  FunctionRef<std::optional<Hit<3>>(double time)> surface_hit);

/// The first point at which a ray enters a solid. `surface_hit` finds the first hit of its triangles, from either
/// side.
bool enter_solid(const DRay<3>& beam, const Composite<3>& solid,
                 FunctionRef<bool(const DRay<3>& beam, PartHit<3>& first)> surface_hit, PartHit<3>& first);

}  // namespace abut::detail
