#pragma once

// Which of many points lie so deep inside of the hull that it need not know them.

#include <abut/math/vec.hpp>

#include <span>
#include <vector>

namespace abut {

/// The points in any order, without many of those that lie strictly inside of the hull of the others: it stays the
/// same, and which ones stay doesn't depend on the order they come in. All of them where they are few, thin, or so
/// large or small that floats might overflow. The points are finite; there is at least one.
///
/// After Akl and Toussaint, "A fast convex hull algorithm" (1978), who drop what lies in the hull of the extremes of a
/// few directions. Here those are the farthest point in each cell of a map of all directions, and a point is compared
/// with a single plane, that of its cell. O(n).
std::vector<Vec3> without_core(std::span<const Vec3> points);

}  // namespace abut
