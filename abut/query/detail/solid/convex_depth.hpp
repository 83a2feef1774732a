#pragma once

// The depth of a convex set in a solid, such as a ball, a capsule, a cylinder or a triangle. For .cpp files.

#include <abut/query/closest.hpp>

namespace abut::detail {

/// Whether a point of the set is inside the solid, if no triangle of the solid is.
bool is_inside_solid(const View<3>& solid, const Convex<3>& set);

/// If the set shares a point with the interior of the solid, and is deeper than touching it: a move of the set that
/// parts the two, and mostly the least one. `on_a` is on the solid. Otherwise false.
bool find_convex_depth(const View<3>& solid, const Convex<3>& set, Closest<3>& closest);

}  // namespace abut::detail
