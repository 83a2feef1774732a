#pragma once

// Removes points deep inside of a hull before it is built.

#include <abut/math/vec.hpp>

#include <span>
#include <vector>

namespace abut::detail {

/// The points in any order, without many of those strictly inside of the hull of the others. The hull stays the same,
/// and the result doesn't depend on the order of the points. All points are returned if they are few, thin, or so large
/// or small that floats might overflow. The points are finite; there is at least one.
///
/// After Akl and Toussaint, "A fast convex hull algorithm" (1978), who remove the points inside of the hull of extreme
/// points along a few directions. Here the extreme points are the farthest of each cell of a map of all directions, and
/// a point is compared with a single plane, that of its cell. O(n).
std::vector<Vec3> without_interior_points(std::span<const Vec3> points);

}  // namespace abut::detail
