#pragma once

#include <abut/convex/hull/hull.hpp>

#include <cstddef>
#include <span>

namespace abut::detail {

/// A hull of at most `count` of the points, 4 or more, of nearly the maximum volume: farthest point sampling from
/// `first`, then each corner moves to the support point along its volume gradient. It may be flat if the points nearly
/// are.
Hull3 inner_hull(std::span<const Vec3> points, std::size_t count, const Vec3& first);

}  // namespace abut::detail
