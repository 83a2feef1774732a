#pragma once

#include <abut/convex/hull.hpp>

#include <cstddef>
#include <span>

namespace abut {

/// A hull of no more than `count` of the points, 4 or more, of nearly the greatest volume: those that are far apart
/// from each other, beginning with `first`, then each put to where it gains most. May be flat where the points nearly
/// are.
Hull3 inner_hull(std::span<const Vec3> points, std::size_t count, const Vec3& first);

}  // namespace abut
